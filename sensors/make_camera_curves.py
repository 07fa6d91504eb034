#!/usr/bin/env python3
"""Writes the quantum efficiencies of rgb-camera.ron from the relative sensitivities of data/camera_nikon_5100_5nm.csv.

    python3 sensors/make_camera_curves.py            # writes rgb-camera/*.csv
    python3 sensors/make_camera_curves.py --check    # fails if a file is not what this script writes

    η_c(λ) = 0.5 (s_c(λ)/λ) / max over c and λ of s_c(λ)/λ          s_c: relative, per energy

The shapes and the ratios of the three channels are those of the source; that the largest quantum efficiency is 0.5 is an ASSUMPTION.
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent / "data" / "camera_nikon_5100_5nm.csv"
LARGEST = 0.5


def rows():
    lines = [line for line in SOURCE.read_text().splitlines() if line and not line.startswith("#")]
    names = lines[0].split(",")[1:]
    table = [[float(x) for x in line.split(",")] for line in lines[1:]]
    return names, table


def texts():
    names, table = rows()
    most = max(value / row[0] for row in table for value in row[1:])
    for k, name in enumerate(names):
        curve = [f"{row[0]:g},{max(0.0, LARGEST * row[k + 1] / row[0] / most):.6g}" for row in table]
        header = [
            f"# name: RGB camera, quantum efficiency of the {name} channel",
            "# quantity: quantum efficiency, electrons per photon",
            "# unit: 1",
            "# wavelength_unit: nm (in air)",
            "# source: shape from Nikon 5100 (NPL), Darrodi et al. 2015, as exported to data/camera_nikon_5100_5nm.csv; divided by the wavelength;",
            f"#   ASSUMED: the largest value of the three channels is {LARGEST}",
            "# licence: BSD-3-Clause (colour-science); the numbers are those of the source",
            "# prepared_by: sensors/make_camera_curves.py",
        ]
        yield HERE / "rgb-camera" / f"{name}.csv", "\n".join(header + [f"wavelength_nm,{name}"] + curve) + "\n"


def main():
    check = "--check" in sys.argv[1:]
    for path, text in texts():
        if not check:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            sys.exit(f"{path} is not what this script writes")


if __name__ == "__main__":
    main()
