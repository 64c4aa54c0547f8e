"""Draws shock.png: the pressure of NACA 0012, M = 0.8, alpha = 1.25 deg by every scheme; prints how each keeps the shock.

Usage: python3 shock.py RUNS, where RUNS/SCHEME is the output of
wingbeat steady CASE 'mesh.airfoil="naca0012"' 'mesh.cells=[256,64]' flow.mach=0.8 flow.angle_of_attack_deg=1.25 flow.scheme=SCHEME
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "apps" / "plots"))

from pressure import sonic_pressure_coefficient  # noqa: E402
from read import read_result, read_table  # noqa: E402
from style import COLOURS, plt  # noqa: E402

SCHEMES = {"jst": "#1f5fa8", "matrix": "#c8501e", "cusp": "#8a4fa3", "roe": "#2f8f57", "van_leer": "#a08018"}
AHEAD, BEHIND = (0.50, 0.60), (0.68, 0.73)  # x/c: where the levels on either side of the shock are taken
SONIC = sonic_pressure_coefficient(0.8, 1.4)


def upper_surface(folder):
    table = read_table(folder / "surface.csv", ["x_body", "cp"])
    x, cp = table["x_body"], table["cp"]
    nose = int(np.argmin(x))
    return x[:nose + 1], cp[:nose + 1], x[nose:], cp[nose:]


def crossing(x, cp, level, start, step):
    """x/c where C_p passes the level, going from one cell by steps of one."""
    i = start
    while (cp[i] - level) * (cp[i + step] - level) > 0.0:
        i += step
    return x[i] + (level - cp[i]) / (cp[i + step] - cp[i]) * (x[i + step] - x[i])


def shock(x, cp):
    """Position, thickness (10 to 90 % of the jump) in chords and cells, worst excess over the level on either side."""
    ahead, behind = (np.mean(cp[(x > lo) & (x < hi)]) for lo, hi in (AHEAD, BEHIND))
    last = int(np.flatnonzero((cp < SONIC) & (x < BEHIND[0]))[-1])
    foot = crossing(x, cp, ahead + 0.1 * (behind - ahead), last + 1, -1)
    top = crossing(x, cp, ahead + 0.9 * (behind - ahead), last, +1)
    near = (x > AHEAD[0]) & (x < BEHIND[1])
    return {"position": crossing(x, cp, SONIC, last, +1), "thickness": top - foot,
            "cells": (top - foot) / (x[last + 1] - x[last]),
            "below": ahead - np.min(cp[near]), "above": np.max(cp[near]) - behind}


def main(runs):
    figure, axes = plt.subplots(figsize=(8, 5.2), layout="constrained")
    inset = axes.inset_axes([0.10, 0.07, 0.42, 0.46])
    print("| scheme | shock at x/c | thickness, chords | cells | excess ahead | excess behind | C_L | C_D |")
    for scheme, colour in SCHEMES.items():
        x_lower, cp_lower, x, cp = upper_surface(runs / scheme)
        axes.plot(x, cp, color=colour, label=scheme)
        axes.plot(x_lower, cp_lower, color=colour, linestyle=(0, (4, 2)), linewidth=0.9)
        inset.plot(x, cp, color=colour, marker="o", markersize=3, linewidth=1.1)
        found, steady = shock(x, cp), read_result(runs / scheme)["steady"]
        print(f"| {scheme} | {found['position']:.4f} | {found['thickness']:.4f} | {found['cells']:.2f} "
              f"| {found['below']:.3f} | {found['above']:.3f} | {steady['cl']:.6f} | {steady['cd']:.6f} |")
    for panel in (axes, inset):
        panel.axhline(SONIC, color=COLOURS["sonic"], linewidth=0.9, linestyle=":")
        panel.invert_yaxis()
    inset.set(xlim=(0.52, 0.72), ylim=(0.18, -1.3))
    inset.tick_params(labelsize=8)
    axes.indicate_inset_zoom(inset, edgecolor=COLOURS["line"])
    axes.set(xlabel="x / c", ylabel=r"pressure coefficient $C_p$",
             title="NACA 0012, Mach 0.8, α = 1.25°, 256 x 64 cells (dashed: lower surface, dotted: sonic)")
    axes.legend(loc="upper right")
    figure.savefig(HERE / "shock.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
