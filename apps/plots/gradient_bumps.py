"""Where the bumps are on the section, and how one of them moves the wall."""

import numpy as np

from gradient import along_normal, frame_section, inches_of, read_crests, read_wall
from read import case_value, read_case
from style import COLOURS, plt

NAME = "gradient-bumps"
SOURCE = "bumps.csv"
CAPTION = ("Shape variables. Above: crests of the bumps on the section, numbered from the lower trailing edge over the "
           "nose to the upper one. Below: the section moved by one of them, much exaggerated.")
MOST_NUMBERED = 40
DRAWN_AMPLITUDE = 0.06  # chords
OFFSET = (8.0, 11.0)  # of a number from its crest, points
DIGIT = 2.5  # and of its wider text, points a digit
WIDTH = 8.2  # of the panels, inches


def outward_normals(wall, s):
    """Unit normals of the wall at arc parameters."""
    normals = np.column_stack([np.interp(s, wall["s"], wall[name]) for name in ("normal_x", "normal_y")])
    return normals / np.linalg.norm(normals, axis=1)[:, None]


def draw_crests(axes, wall, crests):
    axes.fill(wall["x"], wall["y"], facecolor="#f1f3f5", edgecolor=COLOURS["mesh"], linewidth=1.2)
    count = len(crests["bump"])
    size = 5.0 if count <= MOST_NUMBERED else 2.5
    axes.plot(crests["x"], crests["y"], "o", color=COLOURS["flutter"], markersize=size)
    every = -(-count // MOST_NUMBERED)
    for number, x, y, normal in list(zip(crests["bump"], crests["x"], crests["y"],
                                         outward_normals(wall, crests["s"])))[::every]:
        text = f"{number:.0f}"
        offset = normal * (OFFSET[0] + DIGIT * len(text), OFFSET[1])
        axes.annotate(text, (x, y), xytext=offset, textcoords="offset points", ha="center", va="center", fontsize=8)
    axes.set_title(f"{count} bump{'s' if count != 1 else ''}")
    frame_section(axes, wall["x"], wall["y"])


def exaggeration(folder):
    """How much larger the amplitude drawn is than the largest that the case allows."""
    bound = case_value(read_case(folder), "design", "bound")
    told = f"amplitude {100.0 * DRAWN_AMPLITUDE:g} % of the chord"
    return told + (f", {DRAWN_AMPLITUDE / bound:.3g} times the largest allowed" if bound else ", exaggerated")


def draw_sample(axes, folder, wall, crests, moved):
    """The section as it is and moved by the bump that the table gives."""
    axes.fill(*moved, facecolor="#f6e3da", edgecolor="none")
    axes.fill(wall["x"], wall["y"], facecolor="#f1f3f5", edgecolor=COLOURS["line"], linewidth=1.0, label="section")
    number = crests["bump"][np.argmin(np.abs(crests["s"] - wall["s"][np.argmax(wall["sample_bump"])]))]
    axes.plot(*moved, color=COLOURS["structure"], label=f"with bump {number:.0f}")
    axes.set_title(f"Bump {number:.0f}: {exaggeration(folder)}")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 0.0), ncols=2)
    axes.set_xlabel("x / c")
    frame_section(axes, *moved)


def draw(folder):
    crests = read_crests(folder)
    wall = None if crests is None else read_wall(folder, ["sample_bump"])
    if wall is None:
        return None
    moved = along_normal(wall, DRAWN_AMPLITUDE * wall["sample_bump"])
    heights = [inches_of(wall["x"], wall["y"], WIDTH), inches_of(*moved, WIDTH)]
    figure, (above, below) = plt.subplots(2, 1, figsize=(WIDTH + 0.8, sum(heights) + 1.3), height_ratios=heights,
                                          layout="constrained")
    draw_crests(above, wall, crests)
    draw_sample(below, folder, wall, crests, moved)
    return figure
