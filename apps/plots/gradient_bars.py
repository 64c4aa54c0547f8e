"""The gradient, parameter by parameter, by the adjoint and by differences."""

import numpy as np

from gradient import PARAMETERS, SOURCE, objective, read_crests, read_parameters, title_of
from style import COLOURS, mark_zero, plt

__all__ = ["CAPTION", "NAME", "SOURCE", "draw"]

NAME = "gradient-bars"
CAPTION = ("Gradient by the adjoint (blue) and by finite differences (orange) where these were computed: by the "
           "amplitude of each bump, outward positive, and by other parameters, each in its own unit.")
MOST_BARS = 60
ROW = 0.27  # inches of a line of the list
LIST_COLUMNS = [(0.02, "parameter", "left"), (0.34, "", "left"), (0.66, "adjoint", "right"),
                (0.83, "difference", "right"), (0.98, "apart", "right")]


def apart(derivative, difference):
    """Distance of the difference from the derivative, relative to this."""
    scale = np.where(derivative == 0.0, 1.0, np.abs(derivative))
    return np.abs(difference - derivative) / scale


def difference_label(bumps):
    """Names the differences, and how far the farthest is from the adjoint."""
    error = np.nanmax(np.abs(bumps["difference"] - bumps["derivative"]))
    scale = np.nanmax(np.abs(bumps["derivative"]))
    off = f", off by at most {100.0 * error / scale:.2g} % of the largest derivative" if scale > 0.0 else ""
    return "finite difference" + off


def places(folder, bumps):
    """Where each bump is on the abscissa, whether that is the arc parameter, and where the nose is (or None)."""
    crests = read_crests(folder)
    s = {} if crests is None else dict(zip(crests["bump"].astype(int), crests["s"]))
    s = np.array([s.get(number, np.nan) for number in bumps["number"]])
    known = np.isfinite(s).all()
    by_arc = known and len(s) > MOST_BARS
    at = s if by_arc else bumps["number"].astype(float)
    if not known or not (s < 0.5).any() or not (s > 0.5).any():
        return at, by_arc, None
    return at, by_arc, 0.5 if by_arc else 0.5 * (at[s <= 0.5].max() + at[s >= 0.5].min())


def name_surfaces(axes, nose):
    first, last = axes.get_xlim()
    axes.axvspan(nose, last, color="#f4f6f8", linewidth=0, zorder=0)
    for middle, name in ((0.5 * (first + nose), "lower surface"), (0.5 * (nose + last), "upper surface")):
        axes.annotate(name, (middle, 1.0), xycoords=("data", "axes fraction"), xytext=(0, -4),
                      textcoords="offset points", ha="center", va="top", fontsize=9, color=COLOURS["line"])


def draw_bumps(axes, folder, bumps):
    """Bars, or of many bumps a curve along the wall."""
    at, by_arc, nose = places(folder, bumps)
    count, compared = len(at), np.isfinite(bumps["difference"])
    if count <= MOST_BARS:
        axes.bar(at, bumps["derivative"], width=0.72, color=COLOURS["adjoint"], label="adjoint")
        axes.set_xticks(at[::2] if count > 30 else at)
        axes.set_xlim(at.min() - 0.6, at.max() + 0.6)
        axes.grid(False, axis="x")
    else:
        order = np.argsort(at)
        axes.plot(at[order], bumps["derivative"][order], color=COLOURS["adjoint"], label="adjoint")
        axes.set_xlim((0.0, 1.0) if nose is not None else (at.min(), at.max()))
    if compared.any():
        axes.plot(at[compared], bumps["difference"][compared], "D", color=COLOURS["difference"],
                  markerfacecolor="white", markersize=5, markeredgewidth=1.3, label=difference_label(bumps))
    mark_zero(axes)
    axes.margins(y=0.14)
    if nose is not None:
        name_surfaces(axes, nose)
    symbol = objective(folder)[1]
    axes.set(ylabel=rf"$\partial {symbol} / \partial a_i$, per chord",
             xlabel="arc parameter s of the crest, 1/2 at the nose" if by_arc else "bump")
    if compared.any():
        handles, labels = axes.get_legend_handles_labels()
        first = labels.index("adjoint")
        axes.legend([handles[first], handles[1 - first]], [labels[first], labels[1 - first]], ncols=2,
                    loc="lower center", bbox_to_anchor=(0.5, 1.0))


def list_others(axes, symbol, others):
    """A list, since the units differ."""
    count = len(others["name"])
    axes.set(xlim=(0.0, 1.0), ylim=(count + 0.6, -0.6))
    axes.axis("off")
    with_differences = np.isfinite(others["difference"]).any()
    columns = LIST_COLUMNS if with_differences else LIST_COLUMNS[:3]
    for place, head, side in columns:
        axes.text(place, 0, head, ha=side, va="center", fontweight="bold")
    axes.axhline(0.55, color=COLOURS["line"], linewidth=0.8)
    errors = apart(others["derivative"], others["difference"])
    for row, (name, derivative, difference, error) in enumerate(
            zip(others["name"], others["derivative"], others["difference"], errors), 1):
        text, own = PARAMETERS.get(name, (name.replace("_", " "), None))
        cells = [text, rf"$\partial {symbol} / \partial {own}$" if own else "", f"{derivative:.6g}",
                 f"{difference:.6g}" if np.isfinite(difference) else "-",
                 f"{error:.1e}" if np.isfinite(error) else "-"]
        for (place, _, side), words in zip(columns, cells):
            axes.text(place, row, words, ha=side, va="center")


def draw(folder):
    found = read_parameters(folder)
    if found is None:
        return None
    bumps, others = found
    heights = [4.2 if len(bumps["number"]) else 0.0, ROW * (len(others["name"]) + 1.2) if others["name"] else 0.0]
    kept = [height for height in heights if height]
    figure, panels = plt.subplots(len(kept), 1, figsize=(9, sum(kept) + 0.6), squeeze=False, height_ratios=kept,
                                  layout="constrained")
    panels = list(panels[:, 0])
    if heights[0]:
        draw_bumps(panels.pop(0), folder, bumps)
    if heights[1]:
        list_others(panels.pop(0), objective(folder)[1], others)
    figure.suptitle(title_of(folder, "Gradient"), fontsize=11)
    return figure
