#!/usr/bin/env python3
"""Exports the spectral tables of this folder from colour-science 0.4.7 (BSD-3-Clause).

    python3 -m venv venv && venv/bin/pip install colour-science==0.4.7
    venv/bin/python data/export.py            # writes the tables and README.md
    python3 data/export.py --check            # checks header and sha256 of every table; needs no package

The `sha256` of a header is that of all lines after the header, each ended by a line feed. `sum` is the sum of all values of the
table, which the Rust tests compare without a hash.
"""

import hashlib
import math
import pathlib
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
KEYS = ["name", "aliases", "kind", "quantity", "unit", "wavelength_unit", "range", "step", "interpolation", "outside",
        "source", "licence", "prepared_by", "sum", "sha256"]
PACKAGE = "colour-science 0.4.7 on PyPI"
LICENCE = "BSD-3-Clause (colour-science); the numbers are those of the source"
RELATIVE = "relative spectral distribution"

LEF = "CIE 1924 Photopic Standard Observer"
CMF = "CIE 1931 2 Degree Standard Observer"
CHART = "BabelColor Average"
CIE_15 = "CIE 015:2018, Colorimetry, 4th edition"
LAMPS = {
    "D65": (["CIE illuminant D65", "daylight"], f"{CIE_15}"),
    "D50": (["CIE illuminant D50"], f"{CIE_15}"),
    "FL2": (["F2", "CIE illuminant FL2"], f"{CIE_15}, fluorescent lamps"),
    "FL11": (["F11", "CIE illuminant FL11"], f"{CIE_15}, fluorescent lamps"),
    "HP1": (["CIE illuminant HP1", "high pressure sodium"], f"{CIE_15}, high pressure lamps"),
    "LED-B1": (["CIE illuminant LED-B1"], f"{CIE_15}, LED lamps"),
    "LED-B2": (["CIE illuminant LED-B2"], f"{CIE_15}, LED lamps"),
    "LED-B3": (["CIE illuminant LED-B3", "white LED"], f"{CIE_15}, LED lamps"),
    "LED-B4": (["CIE illuminant LED-B4"], f"{CIE_15}, LED lamps"),
    "LED-B5": (["CIE illuminant LED-B5"], f"{CIE_15}, LED lamps"),
}
# The chart's patches as named by its maker, without the density in brackets.
GREYS = {"white 9.5 (.05 D)": "white", "neutral 8 (.23 D)": "neutral 8", "neutral 6.5 (.44 D)": "neutral 6.5",
         "neutral 5 (.70 D)": "neutral 5", "neutral 3.5 (1.05 D)": "neutral 3.5", "black 2 (1.5 D)": "black"}


def number(value):
    """The shortest text that reads back as the same double, after removing the noise of the package's own arithmetic."""
    text = repr(float(f"{float(value):.12g}"))
    return text[:-2] if text.endswith(".0") else text


def write(file_name, wavelengths, columns, header):
    """One table: `columns` is a list of (column name, values)."""
    rows = [",".join(["wavelength_nm", *[name for name, _ in columns]])]
    for i, wavelength in enumerate(wavelengths):
        rows.append(",".join([number(wavelength), *[number(values[i]) for _, values in columns]]))
    body = "\n".join(rows) + "\n"
    steps = {round(b - a, 9) for a, b in zip(wavelengths, wavelengths[1:])}
    total = math.fsum(float(cell) for row in rows[1:] for cell in row.split(",")[1:])
    header = header | {
        "wavelength_unit": "nm (in air)",
        "range": f"{number(wavelengths[0])}-{number(wavelengths[-1])}",
        "step": number(steps.pop()) if len(steps) == 1 else "irregular",
        "interpolation": "linear",
        "outside": header.get("outside", "zero"),
        "licence": LICENCE,
        "prepared_by": "data/export.py",
        "sum": repr(total),
        "sha256": hashlib.sha256(body.encode()).hexdigest(),
    }
    order = KEYS[:2] + [key for key in header if key not in KEYS] + KEYS[2:]
    lines = [f"# {key}: {header[key]}" for key in order]
    (HERE / file_name).write_text("\n".join(lines) + "\n" + body, newline="\n")


def export():
    import colour

    lef = colour.SDS_LEFS[LEF]
    write("v_lambda_1nm.csv", lef.wavelengths, [("v_lambda", lef.values)], {
        "name": "V(lambda)", "aliases": f"V; v-lambda; photopic; {LEF}; CIE 018:2019 V(lambda)", "kind": "factor",
        "quantity": "spectral luminous efficiency for photopic vision", "unit": "1",
        "source": f'CIE 1924, tabulated in CIE 018:2019; {PACKAGE}, colour.SDS_LEFS["{LEF}"]'})

    cmfs = colour.MSDS_CMFS[CMF]
    columns = [(name, cmfs.values[:, i]) for i, name in enumerate(["x_bar", "y_bar", "z_bar"])]
    write("xyz_1931_1nm.csv", cmfs.wavelengths, columns, {
        "name": CMF, "aliases": "CIE 1931; XYZ 1931", "column_aliases": "xbar; ybar; zbar", "kind": "factor",
        "quantity": "colour-matching functions", "unit": "1",
        "source": f'{CIE_15}; {PACKAGE}, colour.MSDS_CMFS["{CMF}"]'})

    for name, (aliases, source) in LAMPS.items():
        lamp = colour.SDS_ILLUMINANTS[name]
        write(f"{name.lower().replace('-', '_')}_5nm.csv", lamp.wavelengths, [("relative", lamp.values)], {
            "name": name, "aliases": "; ".join(aliases), "kind": "density", "quantity": RELATIVE, "unit": "1/nm (relative)",
            "source": f'{source}; {PACKAGE}, colour.SDS_ILLUMINANTS["{name}"]'})

    chart = colour.SDS_COLOURCHECKERS[CHART]
    columns = [(GREYS.get(name, name), sd.values) for name, sd in chart.items()]
    write("colorchecker_babel_10nm.csv", next(iter(chart.values())).wavelengths, columns, {
        "name": "ColorChecker", "aliases": f"ColorChecker {CHART}; colour checker", "kind": "factor",
        "quantity": "spectral reflectance factor", "unit": "1", "outside": "hold",
        "source": "BabelColor, The ColorChecker pages: average of 30 charts; "
                  f'{PACKAGE}, colour.SDS_COLOURCHECKERS["{CHART}"]'})


def read(path):
    """The header as a dictionary, and the text of the rows."""
    lines = path.read_text().splitlines(keepends=True)
    count = sum(1 for line in lines if line.startswith("#"))
    header = dict(line[1:].strip().split(": ", 1) for line in lines[:count])
    return header, "".join(lines[count:])


def check():
    """Number of problems found, each printed."""
    problems = 0
    for path in sorted(HERE.glob("*.csv")):
        header, body = read(path)
        missing = [key for key in KEYS if not header.get(key)]
        digest = hashlib.sha256(body.encode()).hexdigest()
        if missing or digest != header.get("sha256"):
            problems += 1
            print(f"{path.name}: missing {missing}, sha256 of the rows {digest}")
    return problems


def readme():
    lines = ["# Tables", "", textwrap.dedent("""\
        Spectral tables of the library, read by `src/spectrum/library.rs`. Every file has a `#` header with its pedigree; it was
        written by `export.py`, which also checks the files (`--check`). This list is generated from the headers.

        Illuminant A is a formula and illuminant E a constant; neither has a file. Wavelengths in nm, in air; linear between rows.
        """), "| file | name | quantity | range, step | source |", "|---|---|---|---|---|"]
    for path in sorted(HERE.glob("*.csv")):
        header, _ = read(path)
        lines.append(f"| `{path.name}` | {header['name']} | {header['quantity']} | {header['range']}, {header['step']} nm "
                     f"| {header['source']} |")
    lines += ["", "The numbers come from colour-science (Copyright 2013 Colour Developers), distributed under the BSD-3-Clause licence.",
              ""]
    (HERE / "README.md").write_text("\n".join(lines), newline="\n")


if __name__ == "__main__":
    if sys.argv[1:] != ["--check"]:
        export()
        readme()
    sys.exit(1 if check() else 0)
