"""The section before and after an optimisation, and the amplitudes of its bumps."""

import re

import numpy as np

from gradient import ROOM, frame_section
from gradient_bars import MOST_BARS, name_surfaces
from optimization import SECTIONS, SOURCE, design_of, is_optimization
from read import case_value, read_case, read_table
from style import COLOURS, mark_zero, plt

__all__ = ["CAPTION", "NAME", "SOURCE", "draw"]

NAME = "optimization_section"
CAPTION = ("Undeformed and optimised section, true and with y stretched, and the amplitudes of the bumps, outward "
           "positive, between their bounds; bumps on a bound are red.")
WIDTH = 8.2  # of the panels, inches
STRETCHED = 4.2  # inches, at most
MARGIN = 0.02  # above and below the section, chords
BARS = 2.6


def ordinates(path):
    """The points of a file of ordinates; None if it holds none."""
    if not path.is_file():
        return None
    points = []
    for line in path.read_text(errors="replace").splitlines():
        cells = line.split()
        try:
            points.append([float(cells[0]), float(cells[1])])
        except (IndexError, ValueError):
            continue  # a title, a comment
    return np.array(points) if len(points) > 2 else None


def wall_of(path):
    """The wall as the first instance of a run has it, closed."""
    table = read_table(path, ["instance", "x_body", "y_body"])
    if table is None:
        return None
    rows = table["instance"] == table["instance"][0]
    points = np.column_stack([table["x_body"][rows], table["y_body"][rows]])
    return np.vstack([points, points[:1]])


def outline(folder):
    """The section of a folder: its ordinates, else the wall of a run."""
    points = ordinates(folder / "airfoil.dat")
    for path in (folder / "surface.csv", *sorted(folder.glob("*/surface.csv"))):
        points = wall_of(path) if points is None else points
    return points


def plot_outlines(axes, outlines):
    for name, points in outlines.items():
        is_first = name == SECTIONS[0]
        axes.fill(points[:, 0], points[:, 1], facecolor="#f1f3f5" if is_first else "none", edgecolor=COLOURS[name],
                  linewidth=1.2 if is_first else 1.5, label=name)


def height_of(y, factor):
    """Inches of a panel in which y is stretched by a factor."""
    return WIDTH * (factor * np.ptp(y) + 2.0 * MARGIN) / (1.0 + 2.0 * ROOM)


def stretch_of(y):
    """By how much y is stretched: a whole number that leaves the panel flat enough."""
    return max(2, int(STRETCHED / height_of(y, 1.0)))


def draw_outlines(true, stretched, outlines, factor):
    every = np.vstack(list(outlines.values()))
    for axes in (true, stretched):
        plot_outlines(axes, outlines)
        frame_section(axes, every[:, 0], every[:, 1])
    for axes, by in ((true, 1), (stretched, factor)):
        axes.set(aspect=by, ylim=(every[:, 1].min() - MARGIN / by, every[:, 1].max() + MARGIN / by))
    stretched.set(xlabel="x / c", title=f"y stretched {factor} times")
    true.yaxis.set_major_locator(plt.MaxNLocator(4))
    true.tick_params(labelbottom=False)
    true.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0))


def split_design(entries):
    """Bumps, by number, and what else was varied."""
    numbers = [re.fullmatch(r"bump (\d+)", str(entry["name"])) for entry in entries]
    return ([(int(number[1]), entry) for number, entry in zip(numbers, entries) if number],
            [entry for number, entry in zip(numbers, entries) if not number])


def others_text(others):
    """The variables that are no bumps."""
    texts = []
    for entry in others:
        name = str(entry["name"])
        unit = "°" if name.startswith("angle_of_attack") else ""
        bound = f", on its {entry['bound']} bound" if entry.get("bound") else ""
        texts.append(f"change of the {name.replace('_', ' ')}: {entry['value']:+.4g}{unit}{bound}")
    return "; ".join(texts)


def draw_bumps(axes, folder, bumps, title):
    numbers = np.array([number for number, _ in bumps])
    values = 100.0 * np.array([entry["value"] for _, entry in bumps])
    colours = [COLOURS["bound" if entry.get("bound") else "optimum"] for _, entry in bumps]
    axes.bar(numbers, values, width=0.72 if len(bumps) <= MOST_BARS else 1.0, color=colours)
    mark_zero(axes)
    axes.set_xlim(numbers.min() - 0.6, numbers.max() + 0.6)
    axes.xaxis.set_major_locator(plt.MaxNLocator(nbins=26, integer=True))
    axes.grid(False, axis="x")
    case = read_case(folder)
    bound = case_value(case, "design", "bound")
    axes.margins(y=0.14)
    if bound:
        for value in (-100.0 * bound, 100.0 * bound):
            axes.axhline(value, color=COLOURS["bound"], linewidth=1.1, linestyle=(0, (5, 2)), zorder=1)
            axes.annotate(f"{value:+g}".replace("-", "−"), (1.0, value), xycoords=("axes fraction", "data"),
                          xytext=(5, 0), textcoords="offset points", va="center", fontsize=9, color=COLOURS["bound"])
        axes.set_ylim(-125.0 * bound, 140.0 * bound)  # room for the names of the surfaces
    if not case_value(case, "design", "symmetric", False) and len(bumps) > 1:
        name_surfaces(axes, 0.5 * (1.0 + numbers.max()))  # crests are equally spaced
    axes.set(xlabel="bump", ylabel="amplitude, % of chord")
    axes.set_title(title, fontsize=10)


def draw(folder):
    if not is_optimization(folder):
        return None
    outlines = {name: outline(folder / name) for name in SECTIONS}
    outlines = {name: points for name, points in outlines.items() if points is not None}
    entries, is_final = design_of(folder)
    bumps, others = split_design(entries)
    has_shapes = len(outlines) == len(SECTIONS)
    if not has_shapes and not bumps:
        return None
    heights, factor = [], 1
    if has_shapes:
        y = np.concatenate([points[:, 1] for points in outlines.values()])
        factor = stretch_of(y)
        heights = [height_of(y, 1.0), height_of(y, factor)]
    heights += [BARS] if bumps else []
    figure, panels = plt.subplots(len(heights), 1, figsize=(WIDTH + 0.9, sum(heights) + 0.55 * len(heights) + 0.3),
                                  height_ratios=heights, squeeze=False, layout="constrained")
    panels = list(panels[:, 0])
    if has_shapes:
        draw_outlines(panels[0], panels[1], outlines, factor)
    if bumps:
        draw_bumps(panels[-1], folder, bumps, "Bumps" + ("" if is_final else " of the last iteration"))
    if others:
        figure.suptitle(others_text(others), fontsize=11)
    return figure
