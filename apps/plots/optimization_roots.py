"""Roots of the linear flutter problem over the iterations of an optimisation."""

import numpy as np

from optimization import RECORD as SOURCE
from optimization import by_design, is_number, iteration_lines, output_text, places, read_record, restarts
from style import COLOURS, FURTHER, plt

__all__ = ["CAPTION", "NAME", "SOURCE", "draw"]

NAME = "optimization_roots"
CAPTION = ("All roots of the linear flutter problem over the iterations (on a coarser mesh where there is one), those "
           "at which a rising speed destabilises filled, the others hollow; lines: flutter speeds of the optimiser.")
WIDE = 4.0  # ratio of the speeds from which on their axis is logarithmic


def read_roots(lines, iterations):
    """(row of the iteration, root) of every root found."""
    roots = by_design(lines, "roots", "roots")
    of_row = [roots.get(tuple(line.get("design") or []), []) for line in iterations]
    return [(row, root) for row, found in enumerate(of_row) for root in found
            if is_number(root.get("reduced_velocity")) and is_number(root.get("frequency_ratio"))]


def followed(lines, iterations, prefix):
    """Name and values over the iterations of each output that begins so."""
    values = by_design(lines, "values", "outputs")
    rows = [values.get(tuple(line.get("design") or []), {}) for line in iterations]
    names = dict.fromkeys(name for row in rows for name in row if name.startswith(prefix))
    return {name: np.array([float(row[name]) if is_number(row.get(name)) else np.nan for row in rows])
            for name in names}


def plot_roots(axes, at, roots, column):
    for is_filled, label in ((True, "destabilising root"), (False, "stabilising root")):
        chosen = [(at[row], root[column]) for row, root in roots if (root.get("growth_slope", 1.0) > 0.0) == is_filled]
        if chosen:
            axes.plot(*zip(*chosen), "o", color=COLOURS["flutter"], markersize=5.5, label=label,
                      markerfacecolor=COLOURS["flutter"] if is_filled else "white", zorder=4)


def plot_followed(axes, at, found):
    for number, (name, values) in enumerate(found.items()):
        colour = COLOURS["optimum"] if number == 0 else FURTHER[(number - 1) % len(FURTHER)]
        words, symbol = output_text(name)
        axes.plot(at, values, ".-", color=colour, label=f"{words} ${symbol}$ of the optimiser", zorder=3)


def draw(folder):
    lines = read_record(folder)
    iterations = iteration_lines(lines)
    roots = read_roots(lines, iterations)
    if not roots:
        return None
    counts = np.array([line["iteration"] for line in iterations], dtype=float)
    at = places(counts)
    figure, (speed, frequency) = plt.subplots(2, 1, figsize=(8.5, 6.6), sharex=True, height_ratios=[1.5, 1.0],
                                              layout="constrained")
    plot_followed(speed, at, followed(lines, iterations, "flutter_speed"))
    plot_followed(frequency, at, followed(lines, iterations, "flutter_frequency"))
    plot_roots(speed, at, roots, "reduced_velocity")
    plot_roots(frequency, at, roots, "frequency_ratio")
    found = [root["reduced_velocity"] for _, root in roots]
    if min(found) > 0.0 and max(found) > WIDE * min(found):
        speed.set_yscale("log")
    for axes in (speed, frequency):
        for row in restarts(counts):
            axes.axvline(at[row], color=COLOURS["line"], linewidth=0.9, linestyle=":", zorder=1)
        axes.margins(y=0.12)
    speed.set_ylabel(r"reduced velocity $V = U/(c\,\omega_\alpha)$")
    frequency.set(ylabel=r"frequency $\omega/\omega_\alpha$", xlabel="iteration")
    frequency.xaxis.set_major_locator(plt.MaxNLocator(integer=True))
    speed.legend(ncols=2, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2)
    figure.suptitle("Roots of the linear flutter problem over the optimisation", fontsize=11)
    return figure
