"""What the designs of an optimisation cost, by analysis."""

from optimization import SOURCE, is_number, optimization_of
from read import read_result
from style import COLOURS, plt

__all__ = ["CAPTION", "NAME", "SOURCE", "draw"]

NAME = "optimization_cost"
CAPTION = "Seconds that the analyses of all designs took, and the gradients of those that had one."
ROW = 0.5  # inches
COUNTS = [("evaluations", "designs"), ("failed_evaluations", "not solved"),
          ("resumed_evaluations", "of an earlier run")]


def seconds_of(folder):
    """(values, gradients) in seconds of each analysis, the most expensive first."""
    parts = [optimization_of(folder).get(key) or {} for key in ("seconds_of_values", "seconds_of_gradients")]
    names = dict.fromkeys(name for part in parts for name in part)
    found = {name: [part[name] if is_number(part.get(name)) else 0.0 for part in parts] for name in names}
    return dict(sorted(found.items(), key=lambda entry: -sum(entry[1])))


def title_of(folder, total):
    told = optimization_of(folder)
    counts = [f"{told[key]} {words}" for key, words in COUNTS if told.get(key)]
    wall = read_result(folder).get("wall_seconds")
    wall = wall.get("total") if isinstance(wall, dict) else wall
    return "; ".join([f"Analyses: {total:.4g} s" + (f" of {wall:.4g} s in all" if is_number(wall) else ""),
                      ", ".join(counts)]).rstrip("; ")


def draw(folder):
    found = seconds_of(folder)
    if not found:
        return None
    figure, axes = plt.subplots(figsize=(8, ROW * len(found) + 1.9), layout="constrained")
    rows = range(len(found))
    values, gradients = ([part[i] for part in found.values()] for i in (0, 1))
    axes.barh(rows, values, height=0.6, color=COLOURS["flow"], label="values")
    axes.barh(rows, gradients, left=values, height=0.6, color=COLOURS["structure"], label="gradients")
    for row, (value, gradient) in enumerate(zip(values, gradients)):
        axes.annotate(f"{value:.3g} + {gradient:.3g} s", (value + gradient, row), xytext=(5, 0),
                      textcoords="offset points", va="center", fontsize=9)
    axes.set_yticks(list(rows), list(found))
    axes.set_ylim(len(found) - 0.4, -0.6)
    axes.margins(x=0.2)
    axes.set_xlim(left=0.0)
    axes.grid(False, axis="y")
    axes.set_xlabel("wall-clock time, s")
    axes.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    figure.suptitle(title_of(folder, sum(values) + sum(gradients)), fontsize=11)
    return figure
