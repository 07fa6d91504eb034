#!/usr/bin/env python3
"""Exports the spectral tables of this folder from packages under BSD and MIT licences.

    python3 -m venv venv && venv/bin/pip install colour-science==0.4.7
    venv/bin/pip download --no-deps --no-binary pysilsub pysilsub==0.1.1 -d packages
    venv/bin/pip download --no-deps pvlib==0.16.1 -d packages
    venv/bin/python data/export.py packages   # writes the tables, README.md and LICENCES.txt
    python3 data/export.py --check            # checks header and sha256 of every table; needs no package

colour-science is imported; of the two others only data files are read, out of their archives. What each table is, is told in
`tables.py`. The `sha256` of a header is that of all lines after the header, each ended by a line feed. `sum` is the sum of all values of
the table, which the Rust tests compare without a hash.
"""

import hashlib
import importlib.metadata
import math
import pathlib
import sys
import tarfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
KEYS = ["name", "aliases", "group", "kind", "quantity", "unit", "wavelength_unit", "range", "step", "interpolation", "outside",
        "source", "licence", "prepared_by", "sum", "sha256"]
GROUPS = {"observer": "Observers", "component": "Components of observers and illuminants", "illuminant": "Illuminants and the sun",
          "reflectance": "Reflectances", "responsivity": "Responsivities"}
LICENCES = {"colour": "BSD-3-Clause (colour-science); the numbers are those of the source",
            "pysilsub": "MIT (pysilsub); the numbers are those of the source",
            "pvlib": "BSD-3-Clause (pvlib); the numbers are those of the source"}


def number(value):
    """The shortest text that reads back as the same double, after removing the noise of the package's own arithmetic."""
    text = repr(float(f"{float(value):.12g}"))
    return text[:-2] if text.endswith(".0") else text


WRITTEN = set()


def write(file_name, package, wavelengths, columns, header):
    """One table: `columns` is a list of (column name, values)."""
    rows = [",".join(["wavelength_nm", *[name for name, _ in columns]])]
    for i, wavelength in enumerate(wavelengths):
        rows.append(",".join([number(wavelength), *[number(values[i]) for _, values in columns]]))
    body = "\n".join(rows) + "\n"
    steps = {round(b - a, 9) for a, b in zip(wavelengths, wavelengths[1:])}
    total = math.fsum(float(cell) for row in rows[1:] for cell in row.split(",")[1:])
    header = {"wavelength_unit": "nm (in air)", "outside": "zero"} | header | {
        "range": f"{number(wavelengths[0])}-{number(wavelengths[-1])}",
        "step": number(steps.pop()) if len(steps) == 1 else "irregular",
        "interpolation": "linear",
        "licence": LICENCES[package],
        "prepared_by": "data/export.py",
        "sum": repr(total),
        "sha256": hashlib.sha256(body.encode()).hexdigest(),
    }
    order = KEYS[:2] + [key for key in header if key not in KEYS] + KEYS[2:]
    lines = [f"# {key}: {header[key]}" for key in order]
    (HERE / file_name).write_text("\n".join(lines) + "\n" + body, newline="\n")
    WRITTEN.add(HERE / file_name)


class Packages:
    """The archives in a folder, and the files in them."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def pysilsub(self, path):
        with tarfile.open(self.folder / "pysilsub-0.1.1.tar.gz") as archive:
            return archive.extractfile(f"pysilsub-0.1.1/{path}").read().decode("utf-8-sig")

    def pvlib(self, path):
        with zipfile.ZipFile(self.folder / "pvlib-0.16.1-py3-none-any.whl") as archive:
            name = next(name for name in archive.namelist() if name.endswith(path))
            return archive.read(name).decode("utf-8-sig")


def licences(packages):
    colour = next(file for file in importlib.metadata.files("colour-science") if "LICENSE" in str(file))
    texts = [("colour-science 0.4.7", colour.read_text()), ("pysilsub 0.1.1", packages.pysilsub("LICENSE")),
             ("pvlib 0.16.1", packages.pvlib("LICENSE"))]
    parts = ["The numbers of the tables in this folder come from the packages below, under the licences below.\n"]
    parts += [f"{'=' * 20} {name} {'=' * 20}\n\n{text.strip()}\n" for name, text in texts]
    (HERE / "LICENCES.txt").write_text("\n".join(parts), newline="\n")


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
        if missing or digest != header.get("sha256") or header.get("group") not in GROUPS:
            problems += 1
            print(f"{path.name}: missing {missing}, group {header.get('group')}, sha256 of the rows {digest}")
    return problems


def readme():
    """The list of tables, from their headers."""
    tables = [(path, *read(path)) for path in sorted(HERE.glob("*.csv"))]
    lines = ["# Tables", "",
             "Spectral tables of the library, read by `src/spectrum/library`; `etendue list` shows them by name. Every file has a `#`",
             "header with its pedigree. `export.py` writes the files and checks them (`--check`); this list is generated from the headers.",
             "",
             "Illuminant A is a formula and illuminant E a constant; neither has a file. Wavelengths are in nm, in air; linear between",
             "rows.",
             ""]
    for group, title in GROUPS.items():
        members = [table for table in tables if table[1]["group"] == group]
        if not members:
            continue
        lines += [f"## {title}", "", "| name | columns | range, step in nm | unit | file |", "|---|---|---|---|---|"]
        for path, header, body in members:
            columns = body.split("\n", 1)[0].split(",")[1:]
            shown = "" if len(columns) == 1 else ", ".join(columns)
            lines.append(f"| {header['name']} | {shown} | {header['range']}, {header['step']} | {header['unit']} "
                         f"| [{path.name}]({path.name}) |")
        lines += ["", "Sources:", ""]
        lines += [f"* `{path.name}`: {header['source']}" for path, header, _ in members]
        lines.append("")
    lines += ["## Licences", "",
              "The numbers come from colour-science (BSD-3-Clause), pysilsub (MIT) and pvlib (BSD-3-Clause). `LICENCES.txt` holds the",
              "three texts.", ""]
    (HERE / "README.md").write_text("\n".join(lines), newline="\n")


def main():
    if sys.argv[1:] != ["--check"]:
        if len(sys.argv) != 2:
            sys.exit(__doc__)
        # The tables write through this file under its own name, not as the script that runs.
        import export
        import tables
        packages = Packages(sys.argv[1])
        before = set(HERE.glob("*.csv"))
        tables.export(packages)
        for path in before - export.WRITTEN:
            path.unlink()
        licences(packages)
        readme()
    sys.exit(1 if check() else 0)


if __name__ == "__main__":
    main()
