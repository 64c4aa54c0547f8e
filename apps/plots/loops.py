"""Lift and moment against the pitch of a prescribed motion: the harmonics as a curve, the instances as marks."""

import numpy as np

from curves import series
from read import case_value, read_case, read_table
from style import COLOURS, phase_colour, plt

NAME = "loops"
SOURCE = "loads.csv"
CAPTION = ("Lift and moment over one period of the prescribed motion. The curve is the series of harmonics through "
           "the instances (marks); the arrow tells the way round.")


def title_of(folder):
    case = read_case(folder)
    mach, k = case_value(case, "flow", "mach"), case_value(case, "pitch", "reduced_frequency")
    parts = [f"Mach {mach:g}"] if mach else []
    parts += [f"k = {k:g}"] if k else []
    return ", ".join(["Loads of the prescribed motion", *parts])


def draw_loop(axes, table, abscissa, load, colour):
    theta = np.linspace(0.0, 2.0 * np.pi, 721)
    x, y = series(table[abscissa], theta), series(table[load], theta)
    axes.plot(x, y, color=colour)
    at = 45  # an arrow there tells the way round
    axes.annotate("", (x[at + 12], y[at + 12]), xytext=(x[at], y[at]),
                  arrowprops={"arrowstyle": "-|>", "color": colour, "shrinkA": 0, "shrinkB": 0})
    for phase, px, py in zip(table["phase"], table[abscissa], table[load]):
        axes.plot([px], [py], "o", color=phase_colour(phase / (2.0 * np.pi)), markersize=6, zorder=5)
        axes.annotate(f"{np.degrees(phase):.0f}°", (px, py), xytext=(6, 4), textcoords="offset points", fontsize=8,
                      bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.5})


def draw(folder):
    table = read_table(folder / SOURCE, ["phase", "pitch_deg", "plunge", "cl", "cm"])
    if table is None:
        return None
    pitches = np.ptp(table["pitch_deg"]) > 0.0
    abscissa = "pitch_deg" if pitches else "plunge"
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.8), layout="constrained")
    for axes, load, colour, label in zip(panels, ("cl", "cm"), (COLOURS["lift"], COLOURS["moment"]),
                                         (r"lift $C_L$", r"moment $C_M$, nose up")):
        draw_loop(axes, table, abscissa, load, colour)
        axes.set(xlabel="pitch, deg" if pitches else r"plunge $h/b$, positive down", ylabel=label)
        axes.margins(0.1)
    figure.suptitle(title_of(folder), fontsize=11)
    return figure
