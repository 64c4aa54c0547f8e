"""The mesh near the section, whose chord runs from (0, 0) to (1, 0): all of it, and the two ends enlarged."""

import numpy as np
from matplotlib.collections import LineCollection

from read import groups, read_table
from style import COLOURS, plt

NAME = "mesh"
SOURCE = "mesh.csv"
CAPTION = "The mesh near the section, and its two ends enlarged."


def grid_lines(table):
    """Polylines of all grid lines; a line is broken where the table leaves out nodes."""
    lines = []
    for across, along in (("j", "i"), ("i", "j")):
        for rows in groups(zip(table["zone"], table[across])).values():
            rows = rows[np.argsort(table[along][rows], kind="stable")]
            breaks = np.nonzero(np.diff(table[along][rows]) != 1)[0] + 1
            for part in np.split(rows, breaks):
                if len(part) > 1:
                    lines.append(np.column_stack([table["x"][part], table["y"][part]]))
    return lines


def visible(lines, xlim, ylim):
    return [line for line in lines
            if line[:, 0].max() > xlim[0] and line[:, 0].min() < xlim[1]
            and line[:, 1].max() > ylim[0] and line[:, 1].min() < ylim[1]]


def draw_window(axes, lines, centre, width, height, linewidth):
    xlim = (centre[0] - 0.5 * width, centre[0] + 0.5 * width)
    ylim = (centre[1] - 0.5 * height, centre[1] + 0.5 * height)
    axes.add_collection(LineCollection(visible(lines, xlim, ylim), colors=COLOURS["mesh"], linewidths=linewidth))
    axes.set(xlim=xlim, ylim=ylim, aspect="equal", xlabel="x / c", ylabel="y / c")
    axes.grid(False)
    for side in ("top", "right"):
        axes.spines[side].set_visible(True)


def draw(folder):
    table = read_table(folder / SOURCE, ["zone", "i", "j", "x", "y"])
    if table is None:
        return None
    lines = grid_lines(table)
    figure, panels = plt.subplot_mosaic([["whole", "whole"], ["nose", "tail"]], figsize=(9, 9.4),
                                        height_ratios=[1.05, 1.0], layout="constrained")
    draw_window(panels["whole"], lines, (0.5, 0.0), 1.7, 0.95, 0.35)
    draw_window(panels["nose"], lines, (0.03, 0.0), 0.14, 0.14, 0.5)
    draw_window(panels["tail"], lines, (1.0, 0.0), 0.14, 0.14, 0.5)
    zones = len(groups(table["zone"]))
    panels["whole"].set_title(f"Mesh near the section, {zones} block{'' if zones == 1 else 's'}")
    panels["nose"].set_title("leading edge")
    panels["tail"].set_title("trailing edge")
    return figure
