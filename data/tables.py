"""What each table of this folder is: names, columns, sources. Run by `export.py`."""

import csv

import colour

from export import write

COLOUR = "colour-science 0.4.7 on PyPI"
PYSILSUB = "pysilsub 0.1.1 on PyPI"
CIE_15 = "CIE 015:2018, Colorimetry, 4th edition"
RELATIVE = {"group": "illuminant", "kind": "density", "quantity": "relative spectral distribution", "unit": "1/nm (relative)"}
CVRL = "Colour and Vision Research Laboratory"


def export(packages):
    efficiencies()
    matching_functions()
    alpha_opic(packages)
    components(packages)
    daylight()
    lamps()
    sun(packages)
    charts()
    cameras()
    camera_components()


def efficiencies():
    def one(file_name, columns, header):
        tables = [colour.SDS_LEFS[key] for _, key in columns]
        keys = ", ".join(f'"{key}"' for _, key in columns)
        write(file_name, "colour", tables[0].wavelengths, [(name, table.values) for (name, _), table in zip(columns, tables)], header | {
            "group": "observer", "kind": "factor", "unit": "1", "source": f"{header['source']}; {COLOUR}, colour.SDS_LEFS[{keys}]"})

    photopic = "CIE 1924 Photopic Standard Observer"
    one("v_lambda_1nm.csv", [("v_lambda", photopic)], {
        "name": "V(lambda)", "aliases": f"V; v-lambda; photopic; CIE 1924; {photopic}; CIE 018:2019 V(lambda)",
        "quantity": "spectral luminous efficiency for photopic vision", "source": "CIE 1924, tabulated in CIE 018:2019"})
    scotopic = "CIE 1951 Scotopic Standard Observer"
    one("v_prime_1nm.csv", [("v_prime", scotopic)], {
        "name": "V'(lambda)", "aliases": f"V'; V prime; scotopic; CIE 1951; CIE 1951 scotopic; {scotopic}",
        "quantity": "spectral luminous efficiency for scotopic vision", "source": "CIE 1951, tabulated in CIE 018:2019"})
    judd_vos = "Judd-Vos Modified CIE 1978 Photopic Standard Observer"
    one("v_judd_vos_1nm.csv", [("v_m", judd_vos)], {
        "name": "V_M(lambda)", "aliases": f"V_M; Judd-Vos 1978; Judd-Vos; CIE 1988; CIE 1988 V_M(lambda); {judd_vos}",
        "quantity": "spectral luminous efficiency, modified by Judd and Vos",
        "source": "Vos 1978, Colorimetric and photometric properties of a 2 degree fundamental observer; CIE 086-1990"})
    ten = "CIE 1964 Photopic 10 Degree Standard Observer"
    one("v_10_1nm.csv", [("v_10", ten)], {
        "name": "V_10(lambda)", "aliases": f"V_10; V 10 degree; CIE 1964 luminous efficiency; CIE 165:2005 V_10(lambda); {ten}",
        "quantity": "spectral luminous efficiency for a field of 10 degrees", "source": "y_bar of CIE 1964, CIE 165:2005"})
    two, ten = "CIE 2008 2 Degree Physiologically Relevant LEF", "CIE 2008 10 Degree Physiologically Relevant LEF"
    one("v_f_1nm.csv", [("V_F(lambda) 2 degree", two), ("V_F(lambda) 10 degree", ten)], {
        "name": "V_F(lambda)", "aliases": "CIE 2015 luminous efficiency; CIE 2008 luminous efficiency", "column_names_are": "entries",
        "column_aliases": f"V_F 2 degree | V_F 2 | CIE 2015 2 degree luminous efficiency | CIE 2008 2 degree luminous efficiency | {two}; "
                          f"V_F 10 degree | V_F 10 | V_F,10 degree(lambda) | CIE 2015 10 degree luminous efficiency | "
                          f"CIE 2008 10 degree luminous efficiency | {ten}",
        "quantity": "spectral luminous efficiency of physiological axes", "source": f"CIE 170-2:2015; {CVRL}"})


def matching_functions():
    def one(file_name, key, aliases, column_aliases, source, quantity="colour-matching functions", corrections=()):
        table = colour.MSDS_CMFS[key]
        # The package holds some zeros as differences of a few 1e-20.
        columns = [(name, [0.0 if abs(v) < 1e-15 else v for v in table.values[:, i]]) for i, name in enumerate(table.labels)]
        for nm, name, slip, meant in corrections:
            values, row = dict(columns)[name], list(table.wavelengths).index(nm)
            assert abs(values[row] - slip) < 1e-12, (key, nm, name)
            values[row] = meant
        header = {"name": key, "aliases": "; ".join(aliases), "column_aliases": column_aliases, "group": "observer", "kind": "factor",
                  "quantity": quantity, "unit": "1", "source": f'{source}; {COLOUR}, colour.MSDS_CMFS["{key}"]'}
        write(file_name, "colour", table.wavelengths, columns, {name: text for name, text in header.items() if text})

    def letters(names, *forms):
        return "; ".join(" | ".join(form.format(name) for form in forms) for name in names)

    one("xyz_1931_1nm.csv", "CIE 1931 2 Degree Standard Observer", ["CIE 1931", "XYZ 1931", "2 degree observer", "CIE 1931 XYZ"],
        letters("xyz", "{0}_bar", "{0}_bar 1931"), CIE_15)
    one("xyz_1964_1nm.csv", "CIE 1964 10 Degree Standard Observer", ["CIE 1964", "XYZ 1964", "10 degree observer", "CIE 1964 XYZ"],
        letters("xyz", "{0}_bar_10", "{0}_bar 1964"), CIE_15)
    one("xyz_2015_2deg_1nm.csv", "CIE 2015 2 Degree Standard Observer", ["CIE 2015 2 degree", "XYZ 2015 2 degree", "CIE 170-2 2 degree"],
        letters("xyz", "{0}_F_bar", "{0}_bar_F", "{0}_bar 2015 2 degree"), f"CIE 170-2:2015; {CVRL}")
    one("xyz_2015_10deg_1nm.csv", "CIE 2015 10 Degree Standard Observer",
        ["CIE 2015 10 degree", "XYZ 2015 10 degree", "CIE 170-2 10 degree"],
        letters("xyz", "{0}_F,10_bar", "{0}_bar_F,10", "{0}_bar 2015 10 degree"), f"CIE 170-2:2015; {CVRL}")
    cones = "cone fundamentals in energy, peak 1"
    for degree, symbol in ((2, "{0}_bar 2 degree"), (10, "{0}_bar_10")):
        one(f"cones_{degree}deg_1nm.csv", f"Stockman & Sharpe {degree} Degree Cone Fundamentals",
            [f"Stockman & Sharpe {degree} degree", f"Stockman & Sharpe 2000 {degree} degree", f"LMS {degree} degree",
             f"CIE 2006 {degree} degree cone fundamentals", f"CIE 170-1 {degree} degree cone fundamentals",
             f"cone fundamentals {degree} degree"],
            letters("lms", symbol), f"Stockman and Sharpe 2000, CIE 170-1:2006; {CVRL}", cones)
    one("cones_smith_pokorny_5nm.csv", "Smith & Pokorny 1975 Normal Trichromats", ["Smith & Pokorny 1975", "Smith & Pokorny"], "",
        "Smith and Pokorny 1975", "cone fundamentals in energy, peak 1")
    rgb = "colour-matching functions of real primaries"
    one("rgb_wright_guild_5nm.csv", "Wright & Guild 1931 2 Degree RGB CMFs",
        ["Wright & Guild 1931", "Wright & Guild", "CIE 1931 RGB", "RGB 1931"], letters("rgb", "{0}_bar 1931"),
        "CIE 1931, from Wright and from Guild; primaries 700, 546.1 and 435.8 nm; three slips of digits in the package are corrected "
        "(r_bar at 500 nm -0.07137 to -0.07173 and at 580 nm 0.24562 to 0.24526, g_bar at 555 nm 0.20588 to 0.20583): so the rows follow "
        "from x_bar, y_bar, z_bar and the CIE's matrix within 0.00002 as all others do, and the three columns have equal sums", rgb,
        corrections=((500, "r_bar", -0.07137, -0.07173), (580, "r_bar", 0.24562, 0.24526), (555, "g_bar", 0.20588, 0.20583)))
    one("rgb_stiles_burch_1955_5nm.csv", "Stiles & Burch 1955 2 Degree RGB CMFs",
        ["Stiles & Burch 1955", "Stiles & Burch 2 degree", "RGB 1955"], letters("rgb", "{0}_bar 1955"),
        "Stiles and Burch 1955; primaries 645.16, 526.32 and 444.44 nm", rgb)
    one("rgb_stiles_burch_1959_5nm.csv", "Stiles & Burch 1959 10 Degree RGB CMFs",
        ["Stiles & Burch 1959", "Stiles & Burch 10 degree", "RGB 1959"], letters("rgb", "{0}_bar 1959", "{0}_bar_10"),
        "Stiles and Burch 1959; primaries 645.16, 526.32 and 444.44 nm", rgb)


def rows_of(text, skip=1):
    rows = [row for row in csv.reader(text.splitlines()[skip:]) if row]
    return [float(row[0]) for row in rows], [list(cells) for cells in zip(*rows)][1:]


def alpha_opic(packages):
    wavelengths, columns = rows_of(packages.pysilsub("pysilsub/data/CIES026.csv"))
    names = ["sc", "mc", "lc", "rh", "mel"]
    write("s026_1nm.csv", "pysilsub", wavelengths, [(name, [float(v or 0) for v in values]) for name, values in zip(names, columns)], {
        "name": "CIE S 026 action spectra", "aliases": "CIE S 026; CIE S 026/E:2018; alpha-opic; alpha-opic action spectra",
        "column_aliases": "s-cone-opic | cyanopic; m-cone-opic | chloropic; l-cone-opic | erythropic; rhodopic; melanopic",
        "group": "observer", "kind": "factor", "quantity": "alpha-opic action spectrum", "unit": "1",
        "column_quantities": "; ".join(f"{what} action spectrum" for what in
                                       ["s-cone-opic", "m-cone-opic", "l-cone-opic", "rhodopic", "melanopic"]),
        "source": f"CIE S 026/E:2018, five significant digits; {PYSILSUB}, pysilsub/data/CIES026.csv; s-cone-opic is blank there above "
                  "615 nm and 0 here"})


def components(packages):
    wavelengths, absorbance = rows_of(packages.pysilsub("pysilsub/data/CIE_A_lms.csv"))
    others, macula = rows_of(packages.pysilsub("pysilsub/data/CIEPO06_macula_density.csv"))
    again, ocular = rows_of(packages.pysilsub("pysilsub/data/CIEPO06_optical_density.csv"))
    assert wavelengths == others == again
    columns = [(f"absorbance_{cone}", [10 ** float(v) if v.strip() else 0.0 for v in values]) for cone, values in zip("lms", absorbance)]
    columns += [("macula", [float(v) for v in macula[0]])]
    columns += [(name, [float(v) for v in values]) for name, values in zip(["lens_1", "lens_2"], ocular[1:])]
    write("cie170_components_5nm.csv", "pysilsub", wavelengths, columns, {
        "name": "CIE 170-1 components", "aliases": "CIE 2006 components; CIEPO06 components",
        "column_aliases": "L photopigment | L cone pigment; M photopigment | M cone pigment; S photopigment | S cone pigment; "
                          "macular pigment; lens part 1; lens part 2",
        "group": "component", "kind": "factor", "quantity": "components of cone fundamentals", "unit": "1",
        "column_quantities": "absorbance of the L photopigment, peak 1; absorbance of the M photopigment, peak 1; "
                             "absorbance of the S photopigment, peak 1; density of the macular pigment over its density at 460 nm; "
                             "decadic density of lens and media at 32 years, the part that grows with age; "
                             "decadic density of lens and media at 32 years, the part that does not",
        "source": f"CIE 170-1:2006; {PYSILSUB}, pysilsub/data: CIE_A_lms.csv (there the decadic logarithm of the absorbance, here the "
                  "absorbance to 12 digits; S is blank there above 615 nm, where it is below 1e-6, and 0 here), "
                  "CIEPO06_macula_density.csv, CIEPO06_optical_density.csv (columns D_ocul_1 and D_ocul_2)"})


def half_down(value, digits):
    """To `digits` decimals, halves towards zero, as the published D65 has them."""
    scaled = round(value * 10 ** digits, 6)
    return (-(-(scaled - 0.5) // 1)) / 10 ** digits


def d_series_tail(name, nominal_k, last_nm, digits):
    """The illuminant by the formula of CIE 015 above `last_nm`: M1, M2 to three decimals."""
    cct = nominal_k * 1.4388 / 1.4380
    if cct <= 7000:
        x = -4.6070e9 / cct ** 3 + 2.9678e6 / cct ** 2 + 0.09911e3 / cct + 0.244063
    else:
        x = -2.0064e9 / cct ** 3 + 1.9018e6 / cct ** 2 + 0.24748e3 / cct + 0.237040
    y = -3 * x * x + 2.87 * x - 0.275
    m = 0.0241 + 0.2562 * x - 0.7341 * y
    m1 = round((-1.3515 - 1.7703 * x + 5.9114 * y) / m, 3)
    m2 = round((0.03 - 31.4424 * x + 30.0717 * y) / m, 3)
    basis = colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES

    def at(nm):
        return sum(weight * basis[key][nm] for weight, key in ((1, "S0"), (m1, "S1"), (m2, "S2")))

    table = colour.SDS_ILLUMINANTS[name]
    worst = max(abs(at(nm) - value) for nm, value in zip(table.wavelengths, table.values))
    assert worst < 1e-3, (name, worst)
    return [half_down(at(nm), digits) for nm in range(int(last_nm) + 5, 831, 5)]


def daylight():
    columns, wavelengths = [], list(range(300, 831, 5))
    for name, nominal_k, digits in (("D50", 5000, 3), ("D55", 5500, 3), ("D60", 6000, 4), ("D65", 6500, 4), ("D75", 7500, 3)):
        table = colour.SDS_ILLUMINANTS[name]
        values = [float(value) for value in table.values]
        if table.wavelengths[-1] < 830:
            values += d_series_tail(name, nominal_k, table.wavelengths[-1], digits)
        columns.append((name, values))
    write("daylight_5nm.csv", "colour", wavelengths, columns, RELATIVE | {
        "name": "CIE daylight illuminants", "aliases": "CIE D series", "column_names_are": "entries",
        "column_aliases": "horizon light; mid-morning daylight; D60 daylight; daylight | noon daylight; north sky daylight",
        "column_quantities": of_light(f"a phase of daylight, {cct_k} K" for cct_k in (5003, 5503, 6003, 6504, 7504)),
        "source": f"{CIE_15}; {COLOUR}, colour.SDS_ILLUMINANTS, for D50, D55, D65, D75 up to 780 nm; from 785 nm by the formula of the D "
                  "series with M1 and M2 to three decimals, which reproduces the rows up to 780 nm within 0.00051 "
                  "(D65 at 545 nm: 0.00085)"})
    columns = [(name, colour.SDS_ILLUMINANTS[name].values) for name in ("ID50", "ID65")]
    write("indoor_daylight_5nm.csv", "colour", colour.SDS_ILLUMINANTS["ID50"].wavelengths, columns, RELATIVE | {
        "name": "CIE indoor daylight illuminants", "aliases": "CIE ID series", "column_names_are": "entries",
        "column_aliases": "indoor daylight D50; indoor daylight | indoor daylight D65",
        "column_quantities": of_light(f"{name} behind window glass" for name in ("D50", "D65")),
        "source": f"CIE 184:2009, Indoor daylight illuminants; {COLOUR}, colour.SDS_ILLUMINANTS"})
    for name, alias in (("B", "noon sunlight"), ("C", "average daylight")):
        table = colour.SDS_ILLUMINANTS[name]
        write(f"{name.lower()}_5nm.csv", "colour", table.wavelengths, [("relative", table.values)], RELATIVE | {
            "name": name, "aliases": f"{alias}; CIE illuminant {name}",
            "source": f'CIE 1931, withdrawn as a standard; CIE 015; {COLOUR}, colour.SDS_ILLUMINANTS["{name}"]'})
    basis = colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES
    write("d_series_basis_5nm.csv", "colour", basis["S0"].wavelengths, [(key, basis[key].values) for key in ("S0", "S1", "S2")], {
        "name": "D series", "aliases": "daylight basis; CIE D series basis", "group": "component", "kind": "factor",
        "quantity": "basis function of the phases of daylight", "unit": "1/nm (relative)",
        "column_quantities": "; ".join(f"{which} of the phases of daylight" for which in ("mean", "first vector", "second vector")),
        "source": f"{CIE_15}; {COLOUR}, colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES"})


def of_light(lights):
    return "; ".join(f"relative spectral distribution of {light}" for light in lights)


def lamps():
    """Correlated colour temperatures as published in CIE 015."""
    def series(file_name, name, alias, lamps, source):
        tables = [(lamp, colour.SDS_ILLUMINANTS[lamp]) for lamp, *_ in lamps]
        write(file_name, "colour", tables[0][1].wavelengths, [(lamp, table.values) for lamp, table in tables], RELATIVE | {
            "name": name, "aliases": alias, "column_names_are": "entries",
            "column_aliases": "; ".join(names for _, names, *_ in lamps),
            "column_quantities": of_light(f"{what}, {cct_k} K" for *_, what, cct_k in lamps),
            "source": f"{source}; {COLOUR}, colour.SDS_ILLUMINANTS"})

    standard, broad, three = "a standard fluorescent lamp", "a broad-band fluorescent lamp", "a three-band fluorescent lamp"
    series("fluorescent_5nm.csv", "CIE fluorescent lamps FL", "CIE FL series", [
        ("FL1", "F1", standard, 6430), ("FL2", "F2 | CWF | cool white fluorescent", standard, 4230),
        ("FL3", "F3 | white fluorescent", standard, 3450), ("FL4", "F4 | WWF | warm white fluorescent", standard, 2940),
        ("FL5", "F5", standard, 6350), ("FL6", "F6 | light white fluorescent", standard, 4150),
        ("FL7", "F7 | broad-band daylight fluorescent", broad, 6500), ("FL8", "F8 | D50 simulator", broad, 5000),
        ("FL9", "F9 | cool white deluxe fluorescent", broad, 4150), ("FL10", "F10 | TL85 | Ultralume 50", three, 5000),
        ("FL11", "F11 | TL84 | Ultralume 40 | three-band fluorescent", three, 4000),
        ("FL12", "F12 | TL83 | Ultralume 30 | U30", three, 3000)], f"{CIE_15}, fluorescent lamps")
    kinds = [standard] * 3 + ["a deluxe fluorescent lamp"] * 3 + [three] * 5 + ["a multi-band fluorescent lamp"] * 3 + ["a D65 simulator"]
    temperatures = [2932, 3965, 6280, 2904, 4086, 4894, 2979, 4006, 4853, 5000, 5854, 2984, 3896, 5045, 6509]
    series("fluorescent_3_5nm.csv", "CIE fluorescent lamps FL3", "CIE FL3 series",
           [(f"FL3.{i}", f"F3.{i}", kind, cct_k) for i, (kind, cct_k) in enumerate(zip(kinds, temperatures), 1)],
           f"{CIE_15}, fluorescent lamps, new set")
    halide = "a metal halide lamp"
    series("high_pressure_5nm.csv", "CIE high pressure lamps HP", "CIE HP series", [
        ("HP1", "high pressure sodium | HPS | sodium lamp", "a standard high pressure sodium lamp", 1959),
        ("HP2", "colour enhanced high pressure sodium", "a colour enhanced high pressure sodium lamp", 2506),
        ("HP3", "metal halide | metal halide 1", halide, 3144), ("HP4", "metal halide 2", halide, 4002),
        ("HP5", "metal halide 3", halide, 4039)], f"{CIE_15}, high pressure discharge lamps")
    blue, violet = "an LED with blue pump and phosphor", "an LED with violet pump and phosphor"
    series("led_5nm.csv", "CIE LED lamps", "CIE LED series", [
        ("LED-B1", "warm white LED", blue, 2733), ("LED-B2", "LED 2998 K", blue, 2998), ("LED-B3", "white LED", blue, 4103),
        ("LED-B4", "LED 5109 K", blue, 5109), ("LED-B5", "cool white LED", blue, 6598),
        ("LED-BH1", "blue hybrid LED", "a blue LED with phosphor mixed with a red LED", 2851),
        ("LED-RGB1", "RGB LED", "a mixture of red, green and blue LEDs", 2840), ("LED-V1", "violet LED 2724 K", violet, 2724),
        ("LED-V2", "violet LED 4070 K", violet, 4070)], f"{CIE_15}, LED lamps")


def sun(packages):
    wavelengths, columns = rows_of(packages.pvlib("pvlib/data/ASTMG173.csv"), skip=2)
    outside, tilt, direct = [[float(value) for value in values] for values in columns]
    write("astm_g173.csv", "pvlib", wavelengths, [("global tilt", tilt), ("direct", direct), ("extraterrestrial", outside)], {
        "name": "ASTM G173", "aliases": "ASTM G173-03; G173",
        "column_aliases": "sunlight | AM1.5 | AM1.5G | solar global; AM1.5D | solar direct; AM0 | extraterrestrial sun",
        "group": "illuminant", "kind": "density", "quantity": "spectral irradiance of the sun", "unit": "W m^-2 nm^-1",
        "column_quantities": "spectral irradiance of sun and sky on a plane tilted by 37 degrees; "
                             "spectral irradiance of the sun's disc and its surroundings, normal to the sun; "
                             "spectral irradiance of the sun outside the atmosphere",
        "wavelength_unit": "nm (the source does not say in which medium; taken as in air)",
        "source": "ASTM G173-03, SMARTS 2.9.2; pvlib 0.16.1 on PyPI, pvlib/data/ASTMG173.csv"})


# The chart's patches as named by its maker, without the density in brackets.
GREYS = {"white 9.5 (.05 D)": "white", "neutral 8 (.23 D)": "neutral 8", "neutral 6.5 (.44 D)": "neutral 6.5",
         "neutral 5 (.70 D)": "neutral 5", "neutral 3.5 (1.05 D)": "neutral 3.5", "black 2 (1.5 D)": "black"}


def charts():
    for file_name, key, name, aliases, source in (
            ("colorchecker_babel_10nm.csv", "BabelColor Average", "ColorChecker", "BabelColor; ColorChecker BabelColor Average",
             "BabelColor, The ColorChecker pages: average of 30 charts"),
            ("colorchecker_ohta_5nm.csv", "ColorChecker N Ohta", "ColorChecker Ohta",
             "Ohta; ISO 17321-1; ColorChecker N Ohta; ColorChecker ISO 17321-1",
             "Ohta 1997, The Basis of Color Reproduction Engineering; the same numbers as ISO 17321-1:2012")):
        same = colour.SDS_COLOURCHECKERS["ISO 17321-1"]
        assert key != "ColorChecker N Ohta" or all((same[patch].values == table.values).all()
                                                   for patch, table in colour.SDS_COLOURCHECKERS[key].items())
        chart = colour.SDS_COLOURCHECKERS[key]
        columns = [(GREYS.get(patch, patch), table.values) for patch, table in chart.items()]
        write(file_name, "colour", next(iter(chart.values())).wavelengths, columns, {
            "name": name, "aliases": aliases, "group": "reflectance", "kind": "factor", "quantity": "spectral reflectance factor",
            "unit": "1", "outside": "hold", "source": f'{source}; {COLOUR}, colour.SDS_COLOURCHECKERS["{key}"]'})


def cameras():
    for file_name, key, aliases in (("camera_nikon_5100_5nm.csv", "Nikon 5100 (NPL)", "Nikon 5100; Nikon D5100"),
                                    ("camera_sigma_sdmerill_10nm.csv", "Sigma SDMerill (NPL)", "Sigma SD Merrill; Sigma SDMerill")):
        table = colour.MSDS_CAMERA_SENSITIVITIES[key]
        columns = [(name, table.values[:, i]) for i, name in enumerate(table.labels)]
        write(file_name, "colour", table.wavelengths, columns, {
            "name": key, "aliases": aliases, "group": "responsivity", "kind": "factor", "quantity": "relative spectral responsivity",
            "unit": "1 (relative)",
            "source": "Darrodi, Finlayson, Goodman and Mackiewicz 2015, Reference data set for camera spectral sensitivity estimation; "
                      f'{COLOUR}, colour.MSDS_CAMERA_SENSITIVITIES["{key}"]'})


def camera_components():
    """Leading components of measured cameras, a column for each channel and component; values may be negative."""
    from colour.recovery.datasets.dyer2017 import BASIS_FUNCTIONS_DYER2017, SPECTRAL_SHAPE_BASIS_FUNCTIONS_DYER2017
    columns = [(f"{channel} {i + 1}", BASIS_FUNCTIONS_DYER2017[i, :, c])
               for c, channel in enumerate(("red", "green", "blue")) for i in range(4)]
    write("camera_components_10nm.csv", "colour", SPECTRAL_SHAPE_BASIS_FUNCTIONS_DYER2017.wavelengths, columns, {
        "name": "Camera components", "aliases": "Dyer 2017 camera components", "group": "component", "kind": "factor",
        "quantity": "component of the spectral sensitivities of cameras", "unit": "1 (relative)",
        "column_quantities": "; ".join(f"component {i + 1} of the {channel} sensitivities of cameras"
                                       for channel in ("red", "green", "blue") for i in range(4)),
        "source": "Dyer, Forsythe, Irons, Mansencal and Zhu 2017, RAW to ACES Utility Data; "
                  f"{COLOUR}, colour.recovery.datasets.dyer2017.BASIS_FUNCTIONS_DYER2017, the first four of six"})
