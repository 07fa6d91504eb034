#!/usr/bin/env python3
"""Writes bumpy-torus.obj: a torus with waves on it, 768 triangles, counter-clockwise seen from outside. Formula only.

    python3 scenes/make_mesh.py            # writes scenes/bumpy-torus.obj
    python3 scenes/make_mesh.py --check    # fails if the file is not what this script writes

    r(u, v) = 0.12 m (1 + 0.15 sin 7u cos 3v)      x = (0.35 m + r cos v) cos u,  y = (0.35 m + r cos v) sin u,  z = r sin v
"""

import math
import pathlib
import sys

AROUND, ACROSS = 32, 12
HERE = pathlib.Path(__file__).resolve().parent


def obj():
    lines = [
        "# A bumpy torus about the z axis: ring radius 0.35 m, tube radius 0.12 m with waves of 15 %.",
        "# unit: metre; orientation: counter-clockwise seen from outside; closed",
        "# source: formula; written by scenes/make_mesh.py; licence: MIT OR Apache-2.0",
    ]
    for i in range(AROUND):
        for j in range(ACROSS):
            u, v = math.tau * i / AROUND, math.tau * j / ACROSS
            r = 0.12 * (1 + 0.15 * math.sin(7 * u) * math.cos(3 * v))
            ring = 0.35 + r * math.cos(v)
            lines.append(f"v {ring * math.cos(u):.6f} {ring * math.sin(u):.6f} {r * math.sin(v):.6f}")
    for i in range(AROUND):
        for j in range(ACROSS):
            at = lambda a, b: 1 + (a % AROUND) * ACROSS + b % ACROSS
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            lines += [f"f {a} {b} {c}", f"f {a} {c} {d}"]
    return "\n".join(lines) + "\n"


def main():
    path = HERE / "bumpy-torus.obj"
    if "--check" not in sys.argv:
        path.write_text(obj())
    elif not path.exists() or path.read_text() != obj():
        sys.exit(f"{path.name} is not what the script writes")


main()
