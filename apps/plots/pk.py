"""Frequency and damping of every mode against speed, by the p-k method."""

import numpy as np

from read import case_value, groups, read_case, read_result, read_table
from style import COLOURS, mark_speed, mark_zero, mode_colour, plt

NAME = "pk"
SOURCE = "pk.csv"


def flutter_points(result):
    """(label, marker, point) of each flutter point that the run found."""
    points = []
    for key, label, marker in (("linear_flutter", "flutter, linearised", "D"), ("flutter", "flutter, coupled", "*")):
        point = result.get(key) or {}
        if point.get("reduced_velocity") is not None and point.get("frequency_ratio") is not None:
            points.append((label, marker, point))
    return points


def name_of(mode):
    return mode if isinstance(mode, str) else f"mode {mode:g}"


def plot_mode(axes, table, rows, column, colour, label):
    """Solid where p-k converged, dotted where Q was held at the end of its range."""
    values, speed = table[column][rows], table["reduced_velocity"][rows]
    bad = np.array([table["status"][row] != "converged" for row in rows])
    dotted = bad.copy()  # and the neighbours, so that the two meet
    dotted[1:] |= bad[:-1]
    dotted[:-1] |= bad[1:]
    axes.plot(speed, np.where(bad, np.nan, values), color=colour, label=label)
    axes.plot(speed, np.where(dotted, values, np.nan), color=colour, linestyle=":", linewidth=1.2)


def add_speed_index(axes, case):
    """Second scale above: V* = 2 V/sqrt(mu)."""
    mu = case_value(case, "structure", "mass_ratio")
    if not mu:
        return
    factor = 2.0 / np.sqrt(mu)
    top = axes.secondary_xaxis("top", functions=(lambda v: v * factor, lambda v: v / factor))
    top.set_xlabel(r"speed index $V^* = U/(b\,\omega_\alpha\sqrt{\mu})$", fontsize=9)


def draw(folder):
    table = read_table(folder / SOURCE, ["reduced_velocity", "mode", "frequency", "damping", "status"])
    if table is None:
        return None
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(8, 8), sharex=True, layout="constrained")
    for number, (mode, rows) in enumerate(groups(table["mode"]).items()):
        colour = mode_colour(mode, number)
        plot_mode(upper, table, rows, "frequency", colour, name_of(mode))
        plot_mode(lower, table, rows, "damping", colour, None)
    mark_zero(lower)
    for label, marker, point in flutter_points(read_result(folder)):
        speed, omega = point["reduced_velocity"], point["frequency_ratio"]
        size = 13 if marker == "*" else 6
        text = rf"{label}: $V_F$ = {speed:.4f}, $\omega/\omega_\alpha$ = {omega:.4f}"
        upper.plot([speed], [omega], marker, color=COLOURS["flutter"], markersize=size, label=text, zorder=5)
        lower.plot([speed], [0.0], marker, color=COLOURS["flutter"], markersize=size, zorder=5)
        for axes in (upper, lower):
            mark_speed(axes, speed)
    if any(status != "converged" for status in table["status"]):
        upper.plot([], [], ":", color=COLOURS["line"], label="outside the sampled k")
    upper.set(ylabel=r"frequency $\omega/\omega_\alpha$")
    lower.set(ylabel=r"damping $g = 2\,\mathrm{Re}\,p/|p|$,  growing above 0",
              xlabel=r"reduced velocity $V = U/(c\,\omega_\alpha)$", xlim=(0.0, None))
    upper.margins(y=0.15)
    upper.legend(loc="best")
    add_speed_index(upper, read_case(folder))
    figure.suptitle("Frequency and damping of the modes (p-k)", fontsize=11)
    return figure
