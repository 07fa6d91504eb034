#!/usr/bin/env python3
"""Compares `etendue spectrum` with the package colour-science, which knows nothing of it.

usage: colour_science.py ETENDUE [--verbose]

Both get the same spectra: etendue by name, form or file; here they come from the tables and functions of colour-science, or from a
formula, every 0.1 nm, tables being linear between their rows. The curves are those of colour-science. etendue integrates
products of piecewise-linear tables exactly; a trapezoid over 0.1 nm of the same product differs by 1e-7 to 1e-5 of it (FINE). Where a
function of the package integrates by itself, it sums over 1 nm, which differs by up to 1e-4 (PACKAGE_SUM). Every other tolerance
states next to it which difference of conventions it allows for.

Prints what disagrees (with --verbose, everything) and the largest deviation in tolerances; exit code 1 if one is above 1.
"""

import json
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

warnings.filterwarnings("ignore")

import colour  # noqa: E402
import numpy as np  # noqa: E402

try:
    import scipy.spatial.distance  # noqa: E402
except ImportError:
    # The package asks scipy for nothing but the distances between two sets of points; they need no installation of 100 MB.
    import types

    scipy = types.ModuleType("scipy")
    scipy.spatial = types.ModuleType("scipy.spatial")
    scipy.spatial.distance = types.ModuleType("scipy.spatial.distance")
    scipy.spatial.distance.cdist = lambda a, b: np.linalg.norm(a[:, None, :] - b[None, :, :], axis=-1)
    sys.modules.update({"scipy": scipy, "scipy.spatial": scipy.spatial, "scipy.spatial.distance": scipy.spatial.distance})

C2_M_K = 1.438776877503934e-2  # hc/k of the SI; the package has 1.4388e-2

FINE = 2e-5  # relative: trapezoid over 0.1 nm against exact integrals; tables that begin with a jump (s of the cones, 390 nm) cost most
PACKAGE_SUM = 1e-4  # absolute, of chromaticities: sums over 1 nm by the package itself


def grid(low_nm, high_nm):
    return np.linspace(low_nm, high_nm, round((high_nm - low_nm) * 10) + 1)


def linear(rows):
    """A table that is linear between its rows and ends with them."""
    nm, values = zip(*sorted(rows.items()))
    fine = grid(nm[0], nm[-1])
    return fine, np.interp(fine, nm, values)


def of_colour(name):
    sd = colour.SDS_ILLUMINANTS[name]
    return linear(dict(zip(sd.wavelengths, sd.values)))


def gaussian(centre_nm, fwhm_nm):
    sigma, nm = fwhm_nm / (2 * np.sqrt(2 * np.log(2))), grid(300, 900)
    return nm, np.exp(-0.5 * ((nm - centre_nm) / sigma) ** 2)


def ohno_led(peak_nm, fwhm_nm):
    """The package's parameter is the width of the Gaussian in Ohno's formula; ours is the full width at half maximum, where g + 2 g^5 = 3/2."""
    g = max(root.real for root in np.roots([2, 0, 0, 0, 1, -1.5]) if abs(root.imag) < 1e-12)
    sd = colour.colorimetry.sd_single_led_Ohno2005(peak_nm, fwhm_nm / 2 / np.sqrt(-np.log(g)), colour.SpectralShape(300, 900, 0.1))
    return sd.wavelengths, sd.values


def planck(kelvin):
    """By the package's own function with the c2 of the SI; per nm."""
    nm = grid(300, 900)
    return nm, colour.colorimetry.planck_law(nm * 1e-9, kelvin, c2=C2_M_K) * 1e-9


def illuminant_a():
    nm, c2 = grid(300, 830), 1.435e7
    return nm, 100 * (560 / nm) ** 5 * np.expm1(c2 / (2848 * 560)) / np.expm1(c2 / (2848 * nm))


def csv_file(folder):
    """A file of ours: absolute, 5 nm, invented."""
    nm = np.arange(380, 781, 5)
    values = 0.01 * (1 + 0.5 * np.sin(nm / 40) + np.exp(-(((nm - 610) / 30) ** 2)))
    path = Path(folder) / "lamp.csv"
    rows = "".join(f"{a},{b:.12e}\n" for a, b in zip(nm, values))
    path.write_text(f"# wavelength_unit: nm\n# per: nm\n# unit: W/(m² nm)\nwavelength_nm,irradiance\n{rows}")
    return str(path), linear(dict(zip(nm, values)))


class Comparison:
    def __init__(self, program):
        self.program = program
        self.rows = []

    def read(self, *arguments):
        done = subprocess.run([self.program, "spectrum", *arguments, "--format", "json"], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"etendue spectrum {' '.join(arguments)}\n{done.stderr}")
        return {row["id"]: row["value"] for row in json.loads(done.stdout)["quantities"]}

    def check(self, spectrum, quantity, ours, theirs, tolerance, absolute=False):
        ours, theirs = float("nan") if ours is None else float(ours), float(theirs)
        allowed = tolerance if absolute else tolerance * abs(theirs)
        deviation = abs(ours - theirs) / allowed
        self.rows.append((spectrum, quantity, ours, theirs, tolerance, absolute, deviation))

    def report(self, verbose):
        worst = max(self.rows, key=lambda row: row[-1] if row[-1] == row[-1] else np.inf)
        for spectrum, quantity, ours, theirs, tolerance, absolute, deviation in self.rows:
            if verbose or not deviation <= 1:
                kind = "abs" if absolute else "rel"
                print(f"{spectrum:28} {quantity:34} {ours:<22.15g} {theirs:<22.15g} {kind} {tolerance:<8.1g} {deviation:8.2g}")
        print(
            f"{len(self.rows)} quantities of {len({row[0] for row in self.rows})} spectra compared with colour-science "
            f"{colour.__version__}; largest deviation {worst[-1]:.2g} tolerances ({worst[1]} of {worst[0]})"
        )
        return all(row[-1] <= 1 for row in self.rows)


def weighted(spectrum, wavelengths, values):
    """Trapezoid over 0.1 nm of a spectrum and a curve of colour-science."""
    nm, density = spectrum
    return np.trapezoid(density * np.interp(nm, wavelengths, values, left=0.0, right=0.0), nm)


def compare(comparison, name, arguments, spectrum, absolute):
    """Every quantity that colour-science has of one spectrum."""
    check = lambda *rest, **kwargs: comparison.check(name, *rest, **kwargs)  # noqa: E731
    found = comparison.read(*arguments)

    photopic = colour.colorimetry.SDS_LEFS_PHOTOPIC["CIE 1924 Photopic Standard Observer"]
    scotopic = colour.colorimetry.SDS_LEFS_SCOTOPIC["CIE 1951 Scotopic Standard Observer"]
    day, night = (weighted(spectrum, lef.wavelengths, lef.values) for lef in (photopic, scotopic))
    scale = 1.0 if absolute else 1000 / (683.002 * day)
    check("illuminance", found["luminous"], 683.002 * day * scale, FINE)
    check("scotopic illuminance", found["scotopic"], 1700.05 * night * scale, FINE)
    check("S/P", found["sp_ratio"], 1700.05 * night / (683.002 * day), FINE)
    inside_samples = not name.startswith("black body")
    if inside_samples:
        # The package has D50 and D65 up to 780 nm and not to 830 nm, so that only what lies below counts.
        below = 1 - found["infrared_share"] / 100 if spectrum[0][-1] == 780 else 1
        check("luminous efficacy", found["luminous_efficacy"] / below, 683.002 * day / np.trapezoid(spectrum[1], spectrum[0]), FINE)

    # As a spectral distribution of the package: every nm, zero beyond.
    coarse = dict(zip(np.round(spectrum[0][::10]), spectrum[1][::10]))
    sd = colour.SpectralDistribution({nm: coarse.get(float(nm), 0.0) for nm in range(300, 901)})
    if absolute:
        # A function of the package that sums over 1 nm; the spectrum jumps at its ends.
        check("luminous flux (package)", found["luminous"], colour.luminous_flux(sd, photopic, K_m=683.002), PACKAGE_SUM)

    # Mesopic weighting of CIE 191 for the coefficient of adaptation that etendue states: V_mes = m V + (1 - m) V', K_m/V_mes(555 nm).
    m = found["mesopic_adaptation"]
    mesopic = 683.002 * (m * day + (1 - m) * night) / (m + (1 - m) * 683 / 1699)
    check("mesopic illuminance", found["mesopic"], mesopic * scale, FINE)

    for observer, column in [
        ("CIE 1931 2 Degree Standard Observer", "1931"),
        ("CIE 1964 10 Degree Standard Observer", "1964"),
        ("CIE 2015 2 Degree Standard Observer", "2015_2_degree"),
        ("CIE 2015 10 Degree Standard Observer", "2015_10_degree"),
    ]:
        cmfs = colour.MSDS_CMFS[observer]
        xyz = np.array([weighted(spectrum, cmfs.wavelengths, cmfs.values[:, i]) for i in range(3)])
        for letter, value in zip("xz", (xyz[0], xyz[2])):
            # What is next to nothing beside Y = 100 is compared with one.
            allowed = FINE * max(100 * value / xyz[1], 1)
            check(f"{letter.upper()}, Y = 100, {column}", found[f"tristimulus_{letter}_{column}"], 100 * value / xyz[1], allowed, absolute=True)
        x, y = colour.XYZ_to_xy(xyz)
        u, v = colour.xy_to_Luv_uv((x, y))
        for letter, value in (("x", x), ("y", y), ("u_prime", u), ("v_prime", v)):
            check(f"{letter}, {column}", found[f"chromaticity_{letter}_{column}"], value, FINE)
        # The whole way by the package.
        x, y = colour.XYZ_to_xy(colour.sd_to_XYZ(sd.copy().trim(cmfs.shape), cmfs, k=1, method="Integration"))
        for letter, value in (("x", x), ("y", y)):
            check(f"{letter}, {column} (package)", found[f"chromaticity_{letter}_{column}"], value, PACKAGE_SUM, absolute=True)

    # Cones and the receptors that colour-science has curves of.
    for field, degrees in (("2", "2_degree"), ("10", "10_degree")):
        cones = colour.colorimetry.MSDS_CMFS_LMS[f"Stockman & Sharpe {field} Degree Cone Fundamentals"]
        for i, letter in enumerate("lms"):
            value = weighted(spectrum, cones.wavelengths, cones.values[:, i]) * scale
            check(f"{letter} cone, {field} degrees", found[f"{letter}_cone_{degrees}"], value, FINE)

    # Colour temperature at etendue's own chromaticity, so that only the search is compared: Ohno 2013 by table and parabola.
    xy = np.array([found["chromaticity_x_1931"], found["chromaticity_y_1931"]])
    if found["cct"] is not None:
        cct, duv = colour.temperature.uv_to_CCT_Ohno2013(colour.UCS_to_uv(colour.XYZ_to_UCS(colour.xy_to_XYZ(xy))))
        # c2 of the package is 1.4388e-2, that of the SI 1.438776877e-2: 1.6e-5. The table and parabola of the method are good to 1e-4.
        check("CCT (Ohno 2013)", found["cct"], cct * C2_M_K / 1.4388e-2, 1e-4)
        check("Duv (Ohno 2013)", found["duv"], duv, 2e-6, absolute=True)

    # Dominant wavelength, again at the same chromaticity. The package takes the corner of a polygon of 1 nm, so that the wavelength is one of
    # its rows or near it, and closes the polygon from 360 to 780 nm.
    white = np.array([1 / 3, 1 / 3])
    wavelength, _, _ = colour.dominant_wavelength(xy, white)
    ours = found["dominant_wavelength"] if wavelength > 0 else found["complementary_wavelength"]
    check("dominant wavelength", ours, abs(wavelength), 1.0, absolute=True)
    check("excitation purity", found["excitation_purity"], 100 * colour.excitation_purity(xy, white), 0.1, absolute=True)
    check("colorimetric purity", found["colorimetric_purity"], 100 * colour.colorimetric_purity(xy, white), 0.1, absolute=True)

    # sRGB: the package has the matrix of the standard, rounded to four decimals.
    srgb = found["srgb"]
    xyz = colour.xy_to_XYZ(xy)
    linear_rgb = colour.XYZ_to_sRGB(xyz, apply_cctf_encoding=False)
    least = min(linear_rgb.min(), 0.0)
    linear_rgb = linear_rgb + (-least / (1 - least)) * (1 - linear_rgb)
    encoded = colour.cctf_encoding(np.clip(linear_rgb / linear_rgb.max(), 0, 1), function="sRGB")
    for i, letter in enumerate("RGB"):
        check(f"sRGB {letter}", int(srgb[1 + 2 * i : 3 + 2 * i], 16), 255 * encoded[i], 1.0, absolute=True)


def main():
    program = sys.argv[1]
    comparison = Comparison(program)
    with tempfile.TemporaryDirectory() as folder:
        path, samples = csv_file(folder)
        spectra = [
            ("A", ["A"], illuminant_a(), False),
            ("D65", ["D65"], of_colour("D65"), False),
            ("D50", ["D50"], of_colour("D50"), False),
            ("FL2", ["FL2"], of_colour("FL2"), False),
            ("FL11", ["FL11"], of_colour("FL11"), False),
            ("HP1", ["HP1"], of_colour("HP1"), False),
            ("LED-B3", ["LED-B3"], of_colour("LED-B3"), False),
            ("LED-RGB1", ["LED-RGB1"], of_colour("LED-RGB1"), False),
            ("black body 2000 K", ["BlackBody(2000)"], planck(2000), False),
            ("black body 3000 K", ["BlackBody(3000)"], planck(3000), False),
            ("black body 10000 K", ["BlackBody(10000)"], planck(10000), False),
            ("Gaussian 530/30 nm", ["Gaussian(centre_nm: 530, fwhm_nm: 30)"], gaussian(530, 30), False),
            ("Ohno LED 620/20 nm", ["Led(peak_nm: 620, fwhm_nm: 20)"], ohno_led(620, 20), False),
            ("daylight 5500 K", ["Daylight(cct_k: 5500)"], None, False),
            ("a CSV file", [path], samples, True),
        ]
        for name, arguments, spectrum, absolute in spectra:
            if spectrum is None:
                # M1 and M2 are rounded to three decimals there and not here.
                x, y = colour.temperature.CCT_to_xy_CIE_D(5500)
                found = comparison.read(*arguments)
                comparison.check(name, "x of the daylight locus", found["chromaticity_x_1931"], x, 2e-4, absolute=True)
                comparison.check(name, "y of the daylight locus", found["chromaticity_y_1931"], y, 2e-4, absolute=True)
                continue
            compare(comparison, name, arguments, spectrum, absolute)
        luminance = comparison.read("BlackBody(6000)", "--quantity", "radiance")
        # A black body in radiance, W m-2 sr-1 nm-1.
        curve = colour.colorimetry.SDS_LEFS_PHOTOPIC["CIE 1924 Photopic Standard Observer"]
        summed = 683.002 * weighted(planck(6000), curve.wavelengths, curve.values)
        comparison.check("black body 6000 K", "luminance", luminance["luminous"], summed, FINE)
    return 0 if comparison.report("--verbose" in sys.argv) else 1


if __name__ == "__main__":
    sys.exit(main())
