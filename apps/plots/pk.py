"""Frequency and damping of every mode against speed, by the p-k method."""

import numpy as np

from read import case_value, groups, read_case, read_result, read_table
from style import COLOURS, LINES, mark_speed, mark_zero, mode_colour, plt

NAME = "pk"
SOURCE = "pk.csv"
CAPTION = ("Frequency and damping of the modes against speed by the p-k method (full) and, where it was run, the g "
           "method (broken). A mode whose damping rises above zero flutters.")
COMPARED = "Frequency and damping of the modes against speed by the p-k method; one style of line a section."
COLUMNS = ["reduced_velocity", "mode", "frequency", "damping", "status"]


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


def bad_rows(table, rows):
    """Where a root did not converge or Q was held at the end of its range."""
    return np.array([table["status"][row] != "converged" for row in rows])


def plot_mode(axes, table, rows, column, colour, label):
    """Solid where p-k converged, dotted where Q was held at the end of its range."""
    values, speed = table[column][rows], table["reduced_velocity"][rows]
    bad = bad_rows(table, rows)
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


def plot_converged(panels, table, dashes, width):
    """Every mode in its colour where it converged."""
    for number, (mode, rows) in enumerate(groups(table["mode"]).items()):
        for axes, column in zip(panels, ("frequency", "damping")):
            values = np.where(bad_rows(table, rows), np.nan, table[column][rows])
            axes.plot(table["reduced_velocity"][rows], values, color=mode_colour(mode, number), linestyle=dashes,
                      linewidth=width)


def frame(title):
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(8, 8), sharex=True, layout="constrained")
    upper.set(ylabel=r"frequency $\omega/\omega_\alpha$")
    lower.set(ylabel=r"damping $g = 2\,\mathrm{Re}\,p/|p|$,  growing above 0",
              xlabel=r"reduced velocity $V = U/(c\,\omega_\alpha)$")
    mark_zero(lower)
    figure.suptitle(title, fontsize=11)
    return figure, (upper, lower)


def finish(upper, lower, folder):
    lower.set_xlim(0.0, None)
    upper.margins(y=0.15)
    upper.legend(loc="best")
    add_speed_index(upper, read_case(folder))


def draw(folder):
    table = read_table(folder / SOURCE, COLUMNS)
    if table is None:
        return None
    other = read_table(folder / "g_method.csv", COLUMNS)
    figure, (upper, lower) = frame("Frequency and damping of the modes (p-k)" if other is None else
                                   "Frequency and damping of the modes (p-k, g method)")
    for number, (mode, rows) in enumerate(groups(table["mode"]).items()):
        colour = mode_colour(mode, number)
        plot_mode(upper, table, rows, "frequency", colour, name_of(mode))
        plot_mode(lower, table, rows, "damping", colour, None)
    if other is not None:
        plot_converged((upper, lower), other, LINES[1], 2.0)
        upper.plot([], [], color=COLOURS["line"], linestyle=LINES[1], linewidth=2.0, label="g method")
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
    finish(upper, lower, folder)
    return figure


def compare(folders):
    return overlay([(folder.name, folder) for folder in folders])


def overlay(runs):
    """The modes of several runs, (name, folder) each; None if fewer than two have any."""
    found = [(name, folder, read_table(folder / SOURCE, COLUMNS)) for name, folder in runs]
    found = [entry for entry in found if entry[2] is not None]
    if len(found) < 2:
        return None
    figure, panels = frame("Frequency and damping of the modes (p-k)")
    for number, mode in enumerate(dict.fromkeys(mode for *_, table in found for mode in groups(table["mode"]))):
        panels[0].plot([], [], color=mode_colour(mode, number), label=name_of(mode))
    for number, (name, folder, table) in enumerate(found):
        dashes = LINES[number % len(LINES)]
        plot_converged(panels, table, dashes, 1.4)
        point = read_result(folder).get("linear_flutter") or {}
        speed = point.get("reduced_velocity")
        text = name + (rf", $V_F$ = {speed:.4f}" if speed is not None else "")
        panels[0].plot([], [], color=COLOURS["line"], linestyle=dashes, label=text)
        if speed is not None:
            panels[0].plot([speed], [point["frequency_ratio"]], "D", color=COLOURS["flutter"], markersize=6, zorder=5)
            panels[1].plot([speed], [0.0], "D", color=COLOURS["flutter"], markersize=6, zorder=5)
    finish(*panels, found[0][1])
    return figure
