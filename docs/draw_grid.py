"""Draws the grid of a measurement as a false-colour map: value above, relative expanded uncertainty below.

    etendue measure scenes/office.ron --format csv --out docs
    python docs/draw_grid.py docs/office.csv "work plane" docs/office.png

Needs matplotlib. The program's own plots will replace it.
"""
import csv
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

path, instrument, target = sys.argv[1:4]
rows = [r for r in csv.DictReader(open(path)) if r["instrument"] == instrument]
x = sorted({float(r["x_m"]) for r in rows})
y = sorted({float(r["y_m"]) for r in rows})
value = np.zeros((len(y), len(x)))
share = np.zeros_like(value)
for r in rows:
    i, j = int(r["row"]), int(r["column"])
    value[i, j] = float(r["value"])
    share[i, j] = 100 * float(r["expanded_uncertainty"]) / float(r["value"])

plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 9, "text.color": "#262A33", "axes.labelcolor": "#787E8A",
                     "xtick.color": "#787E8A", "ytick.color": "#787E8A"})
figure, axes = plt.subplots(1, 2, figsize=(10.4, 4.0), constrained_layout=True)
for axis, data, cmap, title in ((axes[0], value, "inferno", f"{rows[0]['quantity']}, {rows[0]['unit']}"),
                                (axes[1], share, "viridis", "expanded uncertainty (95 %), % of the reading")):
    picture = axis.imshow(data, origin="lower", extent=(x[0], x[-1], y[0], y[-1]), cmap=cmap, interpolation="bicubic" if axis is axes[0] else "nearest")
    if axis is axes[0]:
        lines = axis.contour(x, y, data, levels=np.arange(250, 551, 50), colors="white", linewidths=0.7, alpha=0.8)
        axis.clabel(lines, fmt="%d", fontsize=8)
    axis.set_title(title, loc="left", fontweight="bold", fontsize=10)
    axis.set_xlabel("x, m")
    axis.set_ylabel("y, m")
    for side in axis.spines.values():
        side.set_visible(False)
    figure.colorbar(picture, ax=axis, shrink=0.85).outline.set_visible(False)
figure.savefig(target, dpi=110)
