"""Flutter boundary, or loads, against the one parameter of a sweep."""

import numpy as np

from style import COLOURS, FURTHER, plt
from sweep import SOURCE as SWEEP
from sweep import branches_of, label, lowest_of, mark_failed, swept_numbers, switches

NAME = "sweep"
SOURCE = SWEEP
CAPTION = ("What was found at each point of the sweep. Each colour is a branch of roots; the heavy line is the lowest, "
           "and a shaded strip marks where it changes from one branch to another. Dotted red: points that failed.")


def draw_branches(axes, key, table, branches, column):
    for (number, rows), colour in zip(sorted(branches.items()), [COLOURS["flow"], COLOURS["structure"], *FURTHER * 9]):
        rows = rows[np.argsort(table[key][rows], kind="stable")]
        axes.plot(table[key][rows], table[column][rows], color=colour, marker="o", markersize=3.5, linewidth=1.0,
                  label=f"branch {number}", zorder=2)


def draw_lowest(axes, key, table, branches, column):
    """The lowest root, broken where its branch changes."""
    places, lowest = lowest_of(table, key, branches)
    value = {(table[key][row], number): table[column][row] for number, rows in branches.items() for row in rows}
    for number in set(lowest):
        curve = [value[place, number] if own == number else np.nan for place, own in zip(places, lowest)]
        axes.plot(places, curve, color="#1c1c1c", linewidth=3.2, alpha=0.25, zorder=3)
    for before, after in switches(places, lowest):
        axes.axvspan(before, after, color=COLOURS["linear"], alpha=0.35, linewidth=0, zorder=0)


def draw(folder):
    found = swept_numbers(folder, 1)
    if found is None or not found[2].any():
        return None
    keys, table, solved, columns = found
    key, rows = keys[0], np.nonzero(solved)[0]
    branches = branches_of(table, rows)
    figure, panels = plt.subplots(len(columns), 1, figsize=(7.2, 3.0 * len(columns) + 0.6), sharex=True,
                                  layout="constrained", squeeze=False)
    for axes, column in zip(panels[:, 0], columns):
        draw_branches(axes, key, table, branches, column)
        if "reduced_velocity" in table:
            draw_lowest(axes, key, table, branches, column)
        mark_failed(axes, set(table[key][~solved]) - set(table[key][rows]))
        axes.set_ylabel(label(column))
    panels[-1, 0].set_xlabel(label(key))
    if len(branches) > 1:
        panels[0, 0].legend()
    figure.suptitle(f"{label(columns[0])} against {label(key)}", fontsize=11)
    return figure
