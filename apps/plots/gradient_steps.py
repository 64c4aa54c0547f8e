"""How far central differences are from the adjoint, step by step."""

import numpy as np

from gradient import title_of
from read import read_table
from style import COLOURS, plt

NAME = "gradient-steps"
SOURCE = "step_study.csv"
CAPTION = ("Error of the central difference along a random direction, relative to the adjoint, against its step. Large "
           "steps: the error of second order; small ones: round-off and unconverged residuals.")
BELOW = 0.4  # of the errors, so that the line is seen beside them


def second_order(step, error):
    """Ends of the steps from the best one up, and of a line of slope 2 below the errors there."""
    best = step[np.argmin(error)]
    above = step >= best if np.sum(step >= best) > 1 else step > 0.0
    factor = BELOW * np.median(error[above] / step[above] ** 2)
    ends = np.array([step[above].min(), step[above].max()])
    return ends, factor * ends**2


def draw(folder):
    table = read_table(folder / SOURCE, ["step", "difference", "relative_error"])
    if table is None:
        return None
    step, error = np.abs(table["step"]), np.abs(table["relative_error"])
    shown = (step > 0.0) & (error > 0.0)
    if not shown.any():
        return None
    order = np.argsort(step[shown])
    step, error = step[shown][order], error[shown][order]
    figure, axes = plt.subplots(figsize=(7, 4.8), layout="constrained")
    axes.loglog(*second_order(step, error), color=COLOURS["line"], linestyle=(0, (4, 2)), label="slope 2")
    axes.loglog(step, error, "o-", color=COLOURS["difference"], markersize=5, label="central difference")
    best = np.argmin(error)
    axes.annotate(f"{error[best]:.1e}", (step[best], error[best]), xytext=(-4, -13), textcoords="offset points",
                  ha="right", fontsize=9)
    axes.margins(y=0.12)
    axes.set(xlabel="step along a random direction", ylabel="error relative to the adjoint")
    axes.legend(loc="best")
    axes.set_title(title_of(folder, "Central differences"), fontsize=11)
    return figure
