"""The motion of a march and what loads it: all of the last run, and its last periods enlarged."""

import numpy as np

from runs import march_runs
from style import COLOURS, mark_zero, plt

NAME = "response"
SOURCE = "march.csv"
CAPTION = "Plunge, pitch and loads of the (last) march: on the left all of it, on the right the last periods."
SHOWN_PERIODS = 4.0
ROWS = [
    (["plunge"], r"plunge $h/b$", [COLOURS["plunge"]]),
    (["pitch_deg"], r"pitch $\alpha$, deg", [COLOURS["pitch"]]),
    (["cl", "cm"], r"$C_L$, $C_M$", [COLOURS["lift"], COLOURS["moment"]]),
]
LOADS = {"cl": r"lift $C_L$", "cm": r"moment $C_M$"}


def window(run):
    """Where the last periods begin; of a short run, its start."""
    time = run["time"]
    omega = run["summary"].get("frequency_ratio") or 1.0
    return max(time[0], time[-1] - SHOWN_PERIODS * 2.0 * np.pi / omega)


def draw(folder):
    runs = march_runs(folder)
    if not runs:
        return None
    run = runs[-1]
    time, start = run["time"], window(run)
    late = time >= start
    figure, panels = plt.subplots(len(ROWS), 2, figsize=(11, 7.5), sharex="col", sharey="row", width_ratios=[1.6, 1.0],
                                  layout="constrained")
    for (whole, end), (names, label, colours) in zip(panels, ROWS):
        for name, colour in zip(names, colours):
            if name in run:
                whole.plot(time, run[name], color=colour, linewidth=0.8)
                end.plot(time[late], run[name][late], color=colour, label=LOADS.get(name))
        whole.axvspan(start, time[-1], color="#f1f3f5", linewidth=0, zorder=0)
        whole.set(ylabel=label)
        whole.margins(x=0.0)
        end.margins(x=0.0)
        mark_zero(whole)
        mark_zero(end)
    panels[-1, 1].legend(loc="upper right", frameon=True, edgecolor="none", framealpha=0.9)
    for axes in panels[-1]:
        axes.set(xlabel=r"time $\omega_\alpha t$")
    figure.suptitle(f"Motion and loads at V = {run['speed']:.4f}", fontsize=11)
    return figure
