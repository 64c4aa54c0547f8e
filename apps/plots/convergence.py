"""Residuals of every iteration, and what the linear solves cost."""

import numpy as np

from read import groups, read_table
from style import COLOURS, plt

NAME = "convergence"
SOURCE = "history.csv"
CAPTION = "Residuals of all stages of the run, and what their linear solves cost."
LOWEST = 1e-16  # round-off
NARROWEST = 0.07  # share of the axis that a stage needs for its name
ROWS = ["flow", "structure", "phase", "energy"]


def shade_stages(axes, stages):
    """A band for each stage, the name above the wide ones."""
    total = sum(len(rows) for rows in stages.values())
    for number, (stage, rows) in enumerate(stages.items()):
        first, last = rows[0] - 0.5, rows[-1] + 0.5
        if number % 2:
            axes.axvspan(first, last, color="#f1f3f5", linewidth=0, zorder=0)
        if len(rows) < NARROWEST * total and len(stages) > 1:
            continue
        axes.annotate(stage, (0.5 * (first + last), 1.0), xycoords=("data", "axes fraction"), xytext=(0, 3),
                      textcoords="offset points", ha="center", va="bottom", fontsize=8)


def plot_residual(axes, table, stages, name):
    """One line a stage; a residual that is exactly zero has no place on the axis."""
    shown = False
    for rows in stages.values():
        values = np.abs(table[name][rows])
        values[values == 0.0] = np.nan
        if np.all(np.isnan(values)):
            continue
        axes.semilogy(rows, values, "o-", color=COLOURS[name], markersize=3, label=None if shown else name)
        shown = True


def draw(folder):
    table = read_table(folder / SOURCE, ["stage", "iteration", "flow"])
    if table is None:
        return None
    stages = groups(table["stage"])
    linear = table.get("linear_iterations")
    figure, panels = plt.subplots(2, 1, figsize=(9, 6.4), sharex=True, height_ratios=[3, 1], layout="constrained")
    upper, lower = panels
    for name in ROWS:
        if name in table:
            plot_residual(upper, table, stages, name)
    shade_stages(upper, stages)
    lowest, highest = upper.get_ylim()
    upper.set(ylabel="residual", ylim=(max(lowest, LOWEST), highest))
    upper.yaxis.set_major_locator(plt.LogLocator(base=10.0, numticks=20))
    upper.legend(loc="best")
    if linear is not None:
        lower.bar(np.arange(len(linear)), np.nan_to_num(linear), color=COLOURS["linear"], width=0.8)
    lower.yaxis.set_major_locator(plt.MaxNLocator(4, integer=True))
    lower.set(ylabel="GMRES\niterations", xlabel=f"iteration, {len(table['stage'])} lines of {SOURCE}",
              xlim=(-0.5, len(table["stage"]) - 0.5))
    seconds = table.get("seconds")
    total = f", {np.nanmax(seconds):.1f} s" if seconds is not None and not np.all(np.isnan(seconds)) else ""
    figure.suptitle(f"Convergence{total}", fontsize=11)
    return figure
