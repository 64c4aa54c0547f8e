"""How the objective changes where the wall is moved along its normal."""

import numpy as np

from gradient import along_normal, frame_section, inches_of, objective, read_wall, title_of
from pressure import surfaces
from style import COLOURS, mark_zero, plt

NAME = "surface-sensitivity"
SOURCE = "wall.csv"
CAPTION = ("Sensitivity to a displacement of the wall along its outward normal, per unit area, the mesh following. "
           "Red: moved outward there, the wall raises the objective; blue: it lowers it.")
BAND = 0.028  # thickness of the coloured band, chords
USUAL = 0.98  # share of the wall: a few nodes at the trailing edge may be far beyond
COLOURED, FRAMED = 1.5, 2.0  # times what is usual, where colours and the frame of the curves end
WIDTH = 7.6  # of the section's panel, inches


def extent(wall, times):
    """Largest size of the sensitivity, but at most so many times what is usual."""
    sizes = np.abs(wall["derivative_normal"])
    faces = np.hypot(np.diff(wall["x"]), np.diff(wall["y"]))
    areas = np.append(faces, 0.0) + np.append(0.0, faces)
    order = np.argsort(sizes)
    order = order[np.isfinite(sizes[order])]
    below = np.cumsum(areas[order])
    usual = sizes[order][np.searchsorted(below, USUAL * below[-1])]
    return min(sizes[order[-1]], times * usual) or 1.0


def draw_band(figure, axes, wall, symbol):
    """The wall, and outside it a band in the colours of the sensitivity."""
    values = wall["derivative_normal"]
    inner, outer = np.column_stack([wall["x"], wall["y"]]), np.column_stack(along_normal(wall, BAND))
    x, y = np.stack([inner, outer]).transpose(2, 0, 1)
    limit = extent(wall, COLOURED)
    band = axes.pcolormesh(x, y, np.stack([values, values]), shading="gouraud", cmap="RdBu_r", vmin=-limit, vmax=limit)
    axes.plot(*outer.T, color=COLOURS["line"], linewidth=0.5)
    axes.fill(wall["x"], wall["y"], facecolor="#f1f3f5", edgecolor=COLOURS["mesh"], linewidth=1.2)
    beyond = "both" if np.nanmax(np.abs(values)) > limit else "neither"
    bar = figure.colorbar(band, ax=axes, extend=beyond, pad=0.02, aspect=12)
    bar.set_label(rf"$\partial {symbol} / \partial n$ per area")
    frame_section(axes, wall["x"], wall["y"])


def draw_curves(axes, wall, symbol):
    """Upper surface full, lower broken, as of the pressure."""
    values = wall["derivative_normal"]
    lower, upper = surfaces(wall["x"], np.arange(len(values)))
    axes.plot(wall["x"][upper], values[upper], color=COLOURS["upper"], label="upper surface")
    axes.plot(wall["x"][lower], values[lower], color=COLOURS["lower"], linestyle=(0, (4, 2)), label="lower surface")
    mark_zero(axes)
    limit, largest = extent(wall, FRAMED), np.nanargmax(np.abs(values))
    if abs(values[largest]) > limit:
        axes.set_ylim(max(np.nanmin(values), -limit), min(np.nanmax(values), limit))
        axes.annotate(f"beyond the frame: up to {values[largest]:.3g} at x = {wall['x'][largest]:.3f}", (0.5, 1.0),
                      xycoords="axes fraction", xytext=(0, 4), textcoords="offset points", ha="center", fontsize=8)
    axes.set(xlabel="x / c", ylabel=rf"$\partial {symbol} / \partial n$ per area")
    axes.legend(loc="best")


def draw(folder):
    wall = read_wall(folder, ["derivative_normal"])
    if wall is None or np.isnan(wall["derivative_normal"]).all():
        return None
    symbol = objective(folder)[1]
    heights = [inches_of(wall["x"], wall["y"], WIDTH), 3.6]
    figure, (above, below) = plt.subplots(2, 1, figsize=(9, sum(heights) + 1.1), sharex=True, height_ratios=heights,
                                          layout="constrained")
    draw_band(figure, above, wall, symbol)
    draw_curves(below, wall, symbol)
    figure.suptitle(title_of(folder, "Surface sensitivity"), fontsize=11)
    return figure
