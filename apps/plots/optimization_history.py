"""Objective and outputs over the iterations of an optimisation, and how far these are from an optimum."""

import numpy as np

from optimization import (NEGLIGIBLE, SOURCE, UNITS, baseline_value, bounds_of, is_optimization, output_label, places,
                          read_history, restarts, sense_of, single_objective)
from read import case_value, read_case
from style import COLOURS, plt

__all__ = ["CAPTION", "NAME", "SOURCE", "draw"]

NAME = "optimization_history"
CAPTION = ("Objective and outputs over the iterations, relative to the undeformed section, with the bounds of the "
           "constraints in red and what they forbid shaded; below, the error of the optimality conditions and the "
           "largest violation of a constraint (none where it has no mark).")
ONE_COLUMN = 4  # panels; more stand in two columns
PANEL, LAST = 1.75, 2.3  # inches
BOUND = {"color": COLOURS["bound"], "linewidth": 1.1, "linestyle": (0, (5, 2))}


def plot_pieces(axes, at, values, begins, **style):
    """A line that is broken wherever the optimiser began anew."""
    for first, last in zip([0, *begins], [*begins, len(at)]):
        axes.plot(at[first:last], values[first:last], **style)
        style.pop("label", None)


def relative(baseline):
    """(change from the baseline in %, or the value itself where there is no baseline to speak of, is relative)."""
    if np.isfinite(baseline) and abs(baseline) > NEGLIGIBLE:
        return lambda value: 100.0 * (value - baseline) / abs(baseline), True
    return lambda value: value, False


def forbid(axes, sign, value, text):
    """Marks a bound, names it beside the frame and shades what it forbids."""
    axes.axhline(value, zorder=1, **BOUND)
    low, high = axes.get_ylim()
    for side, end in (("≤", high), ("≥", low)):
        if sign == side:
            axes.axhspan(value, end, color=COLOURS["bound"], alpha=0.06, linewidth=0, zorder=0)
    axes.set_ylim(low, high)
    axes.annotate(text, (1.0, value), xycoords=("axes fraction", "data"), xytext=(5, 0), textcoords="offset points",
                  va="center", fontsize=9, color=COLOURS["bound"])


def ends_of(values):
    known = values[np.isfinite(values)]
    return f": {known[0]:.5g} → {known[-1]:.5g}" if len(known) else ""


def draw_output(axes, at, values, begins, measure, bounds, title):
    scaled, is_relative = measure
    plot_pieces(axes, at, scaled(values), begins, color=COLOURS["optimum"], marker="o", markersize=3.5)
    axes.margins(y=0.12)
    for _, bound in bounds:  # all within the frame, before any is shaded
        axes.axhline(scaled(bound), linewidth=0)
    for sign, bound in bounds:
        forbid(axes, sign, scaled(bound), f"{sign} {bound:.5g}")
    axes.set_title(title + ends_of(values), loc="left", fontsize=10)
    axes.set_ylabel("change, %" if is_relative else "value")


def draw_errors(axes, folder, at, history, begins):
    for name, colour, marker, label in (("kkt_error", COLOURS["flow"], "o", "error of the optimality conditions (KKT)"),
                                        ("violation", COLOURS["bound"], "s", "largest violation, over its scale")):
        values = np.where(history[name] > 0.0, history[name], np.nan)
        plot_pieces(axes, at, values, begins, color=colour, marker=marker, markersize=3.5, label=label)
    axes.set_yscale("log")
    restoring = np.nonzero(np.nan_to_num(history["is_restoring"]) > 0.5)[0]
    for number, row in enumerate(restoring):
        axes.axvspan(at[row] - 0.5, at[row] + 0.5, color=COLOURS["linear"], alpha=0.3, linewidth=0, zorder=0,
                     label=None if number else "restoring feasibility")
    tolerance = case_value(read_case(folder), "optimize", "tolerance")
    if tolerance:
        axes.axhline(tolerance, color=COLOURS["line"], linewidth=1.0, linestyle=":", label=f"tolerance {tolerance:g}")
    axes.legend(ncols=2, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2)
    axes.set(xlabel="iteration", ylabel="error")


def panels_of(folder, history, outputs):
    """(title, values, measure, bounds) of each panel: the objective first, unless an output is it."""
    objective, sense = single_objective(folder), sense_of(folder)
    note = f" (objective{', ' + sense if sense else ''})"
    panels = []
    if objective not in outputs and any(np.any(history["objective"] != history[name]) for name in outputs):
        # A sum of ratios to the baseline: it has no scale but itself.
        panels.append((note.strip(" ()"), history["objective"], relative(np.nan), []))
    for name in outputs:
        unit = f", {UNITS[name]}" if name in UNITS else ""
        panels.append((output_label(name) + unit + (note if name == objective else ""), history[name],
                       relative(baseline_value(folder, history, name)), bounds_of(folder, name)))
    return panels


def make_panels(count):
    """A figure with panels of equal size, and a wider one below them."""
    columns = 1 if count <= ONE_COLUMN else 2
    rows = -(-count // columns)
    figure = plt.figure(figsize=(8.5 if columns == 1 else 12.5, rows * PANEL + LAST + 0.4), layout="constrained")
    grid = figure.add_gridspec(rows + 1, columns, height_ratios=[PANEL] * rows + [LAST])
    panels = [figure.add_subplot(grid[number // columns, number % columns]) for number in range(count)]
    return figure, panels, figure.add_subplot(grid[rows, :])


def draw(folder):
    found = read_history(folder) if is_optimization(folder) else None
    if found is None:
        return None
    history, outputs = found
    at, begins = places(history["iteration"]), restarts(history["iteration"])
    panels = panels_of(folder, history, outputs)
    figure, frames, below = make_panels(len(panels))
    for axes, (title, values, measure, bounds) in zip(frames, panels):
        draw_output(axes, at, values, begins, measure, bounds, title)
    draw_errors(below, folder, at, history, begins)
    for axes in (*frames, below):
        for row in begins:
            axes.axvline(at[row], color=COLOURS["line"], linewidth=0.9, linestyle=":", zorder=1)
        axes.set_xlim(at.min() - 0.3, at.max() + 0.3)
        axes.xaxis.set_major_locator(plt.MaxNLocator(integer=True))
    figure.suptitle("Optimisation" + ("; dotted: begun anew with a further flutter root" if len(begins) else ""),
                    fontsize=11)
    return figure
