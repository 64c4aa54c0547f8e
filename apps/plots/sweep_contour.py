"""Flutter boundary, or loads, over the two parameters of a sweep."""

import numpy as np

from style import COLOURS, plt
from sweep import SOURCE as SWEEP
from sweep import label, swept_numbers

NAME = "sweep-contour"
SOURCE = SWEEP
CAPTION = ("What was found over the two parameters of the sweep, at flutter the lowest root; dots are points that were "
           "solved, crosses points that failed.")
LEVELS = 15


def lowest_rows(table, keys, rows):
    """Of every point the row with the lowest speed, where there is one; else the first."""
    best = {}
    for row in rows:
        point = tuple(table[key][row] for key in keys)
        is_lower = point in best and "reduced_velocity" in table and (
            table["reduced_velocity"][row] < table["reduced_velocity"][best[point]])
        if point not in best or is_lower:
            best[point] = row
    return np.array(list(best.values()))


def draw(folder):
    found = swept_numbers(folder, 2)
    if found is None:
        return None
    keys, table, solved, columns = found
    rows = lowest_rows(table, keys, np.nonzero(solved)[0])
    x, y = table[keys[0]], table[keys[1]]
    if len(rows) < 3 or min(len(np.unique(x[rows])), len(np.unique(y[rows]))) < 2:
        return None
    figure, panels = plt.subplots(1, len(columns), figsize=(5.4 * len(columns), 4.4), layout="constrained",
                                  squeeze=False, sharey=True)
    for axes, column in zip(panels[0], columns):
        drawn = axes.tricontourf(x[rows], y[rows], table[column][rows], levels=LEVELS, cmap="viridis")
        figure.colorbar(drawn, ax=axes, label=label(column))
        axes.plot(x[rows], y[rows], ".", color="white", markersize=4)
        axes.plot(x[~solved], y[~solved], "x", color=COLOURS["bound"])
        axes.set_xlabel(label(keys[0]))
    panels[0, 0].set_ylabel(label(keys[1]))
    return figure
