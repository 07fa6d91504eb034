#!/usr/bin/env python3
"""Compares `etendue spectrum` with the package colour-science, which knows nothing of it.

usage: colour_science.py ETENDUE [--verbose]

Both get the same spectra: etendue by name or by file, colour-science as 1 nm samples that this script computes itself or takes from
the tables of colour-science, linear between rows. etendue integrates products of tables exactly; here they are sums over 1 nm
(trapezoid: the error of a sum of smooth products is of the order of the second derivative, some 1e-6 to 1e-5 of the value, more where a
spectrum has narrow peaks). Tolerances state which difference of conventions they allow for. Prints a table and the largest
deviation in tolerances; exit code 1 if one is above 1.
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

SHAPE = colour.SpectralShape(300, 830, 1)
WAVELENGTHS = SHAPE.wavelengths

# Relative tolerances unless the name says otherwise.
SUM = 2e-5  # sum over 1 nm against exact integral
SUM_OF_SPIKES = 3e-4  # the same for the 5 nm corners of fluorescent lamps and LEDs


def linear(rows):
    """1 nm samples of a table that is linear between its rows and zero outside."""
    nm, values = zip(*sorted(rows.items()))
    return np.interp(WAVELENGTHS, nm, values, left=0.0, right=0.0)


def of_colour(group, name):
    sd = colour.SDS_ILLUMINANTS[name]
    return linear(dict(zip(sd.wavelengths, sd.values)))


def gaussian(centre_nm, fwhm_nm):
    sigma = fwhm_nm / (2 * np.sqrt(2 * np.log(2)))
    return np.exp(-0.5 * ((WAVELENGTHS - centre_nm) / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))


def ohno_led(peak_nm, half_width_nm):
    return colour.sd_single_led(SHAPE, method="Ohno 2005", peak_wavelength=peak_nm, half_spectral_width=half_width_nm / 2).values


def planck(kelvin):
    """By colour-science's own function, with its constants; the 1 nm samples are the spectrum there."""
    return colour.sd_blackbody(kelvin, SHAPE).values


def illuminant_a():
    c2 = 1.435e7
    return 100 * (560 / WAVELENGTHS) ** 5 * np.expm1(c2 / (2848 * 560)) / np.expm1(c2 / (2848 * WAVELENGTHS))


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


def weighted(values, curve):
    """Sum over 1 nm of a spectrum and a curve of colour-science."""
    table = np.interp(WAVELENGTHS, curve.wavelengths, curve.values, left=0.0, right=0.0)
    return np.trapezoid(values * table, WAVELENGTHS)


def compare(comparison, name, arguments, values, spikes, absolute):
    """Every quantity that colour-science has of one spectrum."""
    check = lambda *rest, **kwargs: comparison.check(name, *rest, **kwargs)  # noqa: E731
    found = comparison.read(*arguments)
    tolerance = SUM_OF_SPIKES if spikes else SUM

    # Luminous. colour-science has K_m = 683.002 since 0.4.x for SI; the sum of it is taken here with its table of V.
    photopic = colour.SDS_LEFS_PHOTOPIC["CIE 1924 Photopic Standard Observer"]
    scotopic = colour.SDS_LEFS_SCOTOPIC["CIE 1951 Scotopic Standard Observer"]
    sd = colour.SpectralDistribution(values, WAVELENGTHS)
    luminous, dark = 683.002 * weighted(values, photopic), 1700.05 * weighted(values, scotopic)
    scale = 1.0 if absolute else 1000 / luminous
    check("illuminance", found["luminous"], luminous * scale, tolerance)
    check("scotopic illuminance", found["scotopic"], dark * scale, tolerance)
    check("S/P", found["sp_ratio"], dark / luminous, tolerance)
    if absolute:
        # luminous_flux of the package sums with K_m = 683 (its constant), 2.9e-6 below ours.
        check("luminous flux (package)", found["luminous"], colour.luminous_flux(sd, photopic, K_m=683.002), tolerance)
    if not name.startswith("black body"):
        # A black body reaches beyond the samples.
        efficacy = colour.luminous_efficacy(sd, photopic) * 683.002 / 683.0
        check("luminous efficacy", found["luminous_efficacy"], efficacy, tolerance)

    # Mesopic weighting of CIE 191 for the coefficient of adaptation that etendue states: V_mes = m V + (1 - m) V'.
    m = found["mesopic_adaptation"]
    v_mes = m * np.interp(WAVELENGTHS, photopic.wavelengths, photopic.values, left=0, right=0)
    v_mes += (1 - m) * np.interp(WAVELENGTHS, scotopic.wavelengths, scotopic.values, left=0, right=0)
    v_mes_555 = m + (1 - m) * 683 / 1699
    check("mesopic illuminance", found["mesopic"], 683.002 / v_mes_555 * np.trapezoid(values * v_mes, WAVELENGTHS) * scale, tolerance)

    # Tristimulus values by the package, by its integration over 1 nm.
    for observer, column in [
        ("CIE 1931 2 Degree Standard Observer", "1931"),
        ("CIE 1964 10 Degree Standard Observer", "1964"),
        ("CIE 2015 2 Degree Standard Observer", "2015_2_degree"),
        ("CIE 2015 10 Degree Standard Observer", "2015_10_degree"),
    ]:
        cmfs = colour.MSDS_CMFS[observer]
        xyz = colour.sd_to_XYZ(sd.copy().align(cmfs.shape, extrapolator_kwargs={"method": "Constant", "left": 0, "right": 0}), cmfs, k=1, method="Integration")
        for letter, value in zip("xz", (xyz[0], xyz[2])):
            check(f"{letter.upper()}, Y = 100, {column}", found[f"tristimulus_{letter}_{column}"], 100 * value / xyz[1], tolerance)
        x, y = colour.XYZ_to_xy(xyz)
        u, v = colour.xy_to_Luv_uv((x, y))
        for letter, value in (("x", x), ("y", y), ("u_prime", u), ("v_prime", v)):
            check(f"{letter}, {column}", found[f"chromaticity_{letter}_{column}"], value, tolerance)

    # Cones and the receptors that colour-science has curves of.
    for field, degrees in (("2", "2_degree"), ("10", "10_degree")):
        cones = colour.MSDS_CMFS_LMS[f"Stockman & Sharpe {field} Degree Cone Fundamentals"]
        for i, letter in enumerate("lms"):
            curve = colour.SpectralDistribution(cones.values[:, i], cones.wavelengths)
            check(f"{letter} cone, {field} degrees", found[f"{letter}_cone_{degrees}"], weighted(values, curve) * scale, tolerance)

    # Colour temperature at etendue's own chromaticity, so that only the search is compared: Ohno 2013 by table and parabola.
    xy = np.array([found["chromaticity_x_1931"], found["chromaticity_y_1931"]])
    if found["cct"] is not None:
        cct, duv = colour.temperature.uv_to_CCT_Ohno2013(colour.UCS_to_uv(colour.XYZ_to_UCS(colour.xy_to_XYZ(xy))))
        # c2 of the package is 1.4388e-2, that of the SI 1.438776877e-2: 1.6e-5. The method itself is good to about 1 K.
        check("CCT (Ohno 2013)", found["cct"], cct / (1.4388e-2 / 1.438776877e-2), 3e-4)
        check("Duv (Ohno 2013)", found["duv"], duv, 2e-5, absolute=True)

    # Dominant wavelength, again at the same chromaticity. The package takes the corner of a polygon of 1 nm, so that the wavelength is one of
    # its rows or near it, and closes the polygon from 360 to 780 nm.
    white = np.array([1 / 3, 1 / 3])
    wavelength, _, _ = colour.dominant_wavelength(xy, white)
    ours = found["dominant_wavelength"] if wavelength > 0 else found["complementary_wavelength"]
    check("dominant wavelength", ours, abs(wavelength), 1.0, absolute=True)
    check("excitation purity", found["excitation_purity"], 100 * colour.excitation_purity(xy, white), 0.3, absolute=True)
    check("colorimetric purity", found["colorimetric_purity"], 100 * colour.colorimetric_purity(xy, white), 0.5, absolute=True)

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
            ("A", ["A"], illuminant_a(), False, False),
            ("D65", ["D65"], of_colour("CIE", "D65"), False, False),
            ("D50", ["D50"], of_colour("CIE", "D50"), False, False),
            ("FL2", ["FL2"], of_colour("FL", "FL2"), True, False),
            ("FL11", ["FL11"], of_colour("FL", "FL11"), True, False),
            ("HP1", ["HP1"], of_colour("HP", "HP1"), True, False),
            ("LED-B3", ["LED-B3"], of_colour("LED", "LED-B3"), True, False),
            ("LED-RGB1", ["LED-RGB1"], of_colour("LED", "LED-RGB1"), True, False),
            ("black body 2000 K", ["BlackBody(2000)"], planck(2000), False, False),
            ("black body 3000 K", ["BlackBody(3000)"], planck(3000), False, False),
            ("black body 10000 K", ["BlackBody(10000)"], planck(10000), False, False),
            ("Gaussian 530/30 nm", ["Gaussian(centre_nm: 530, fwhm_nm: 30)"], gaussian(530, 30), False, False),
            ("Ohno LED 620/20 nm", ["Led(peak_nm: 620, fwhm_nm: 20)"], ohno_led(620, 20), False, False),
            ("daylight 5500 K", ["Daylight(cct_k: 5500)"], None, False, False),
            ("a CSV file", [path], samples, True, True),
        ]
        for name, arguments, values, spikes, absolute in spectra:
            if values is None:
                # M1 and M2 are rounded to three decimals there and not here.
                x, y = colour.temperature.CCT_to_xy_CIE_D(5500)
                found = comparison.read(*arguments)
                comparison.check(name, "x of the daylight locus", found["chromaticity_x_1931"], x, 2e-4, absolute=True)
                comparison.check(name, "y of the daylight locus", found["chromaticity_y_1931"], y, 2e-4, absolute=True)
                continue
            compare(comparison, name, arguments, values, spikes, absolute)
        luminance = comparison.read("BlackBody(6000)", "--quantity", "radiance")
        # A black body in radiance: the package in W m-3 sr-1, summed; its c2 differs by 1.6e-5, which is 7e-5 in luminance.
        curve = colour.SDS_LEFS_PHOTOPIC["CIE 1924 Photopic Standard Observer"]
        summed = 683.002 * weighted(colour.colorimetry.planck_law(WAVELENGTHS * 1e-9, 6000) * 1e-9, curve)
        comparison.check("black body 6000 K", "luminance", luminance["luminous"], summed, 1e-4)
    return 0 if comparison.report("--verbose" in sys.argv) else 1


if __name__ == "__main__":
    sys.exit(main())
