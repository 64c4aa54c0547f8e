"""Pressure on the section at every instance of the period."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize

from read import case_value, groups, read_case, read_result, read_table
from runs import march_summaries
from style import COLOURS, mark_zero, phase_colour, plt

NAME = "pressure"
SOURCE = "surface.csv"
CAPTION = ("Pressure coefficient on the section, suction upwards; full: upper surface, broken: lower. Of a periodic "
           "flow each instance, and below how far it departs from their mean.")
MOST_IN_LEGEND = 7


def sonic_pressure_coefficient(mach, gamma):
    """C_p at which an isentropic flow from the free stream reaches Mach 1."""
    ratio = (2.0 + (gamma - 1.0) * mach**2) / (gamma + 1.0)
    return 2.0 / (gamma * mach**2) * (ratio ** (gamma / (gamma - 1.0)) - 1.0)


def instances_of(table):
    """(phase, rows) of each instance."""
    return [(table["phase"][rows[0]], rows) for rows in groups(table["instance"]).values()]


def surfaces(x, rows):
    """Rows of the lower and of the upper surface: they run from tail to nose and back."""
    nose = int(np.argmin(x[rows]))
    return rows[:nose + 1], rows[nose:]


def plot_instance(axes, x, values, rows, colour, label, linewidth=1.4):
    lower, upper = surfaces(x, rows)
    axes.plot(x[upper], values[upper], color=colour, linewidth=linewidth, label=label)
    axes.plot(x[lower], values[lower], color=colour, linewidth=linewidth, linestyle=(0, (4, 2)))


def label_of(phase):
    return rf"$\theta$ = {round(np.degrees(phase))}°"


def add_key(figure, axes, instances):
    if len(instances) <= MOST_IN_LEGEND:
        handles, labels = axes.get_legend_handles_labels()
        axes.legend(handles, labels, loc="upper right", frameon=True, edgecolor="none", framealpha=1.0)
        return
    wheel = ListedColormap([phase_colour(turn) for turn in np.linspace(0.0, 1.0, 256)])
    bar = figure.colorbar(ScalarMappable(Normalize(0.0, 360.0), wheel), ax=figure.axes, pad=0.01, aspect=40)
    bar.set_label("phase of the period, deg")


def title_of(folder, periodic):
    result, case = read_result(folder), read_case(folder)
    parts = [f"Mach {case_value(case, 'flow', 'mach'):g}"] if case_value(case, "flow", "mach") else []
    cycles = [result.get("flutter"), *(result.get("lco") or []), *march_summaries(folder)]
    amplitude = next((cycle.get("pitch_amplitude_deg") for cycle in reversed(cycles) if cycle), None)
    if "pitch" in result:
        amplitude = case_value(case, "pitch", "amplitude_deg")
    if periodic and amplitude:
        parts.append(f"pitch amplitude {amplitude:.3g}°")
    return "Pressure on the section" + "".join(f", {part}" for part in parts)


def draw_changes(axes, table, instances):
    """How far each instance departs from their mean: of a small motion, all there is to see."""
    cp = np.array([table["cp"][rows] for _, rows in instances])
    mean = cp.mean(axis=0)
    values = table["cp"].copy()
    for _, rows in instances:
        values[rows] -= mean
    for phase, rows in instances:
        plot_instance(axes, table["x_body"], values, rows, phase_colour(phase / (2.0 * np.pi)), None)
    mark_zero(axes)
    axes.set(ylabel=r"$C_p$ less its mean")
    axes.ticklabel_format(axis="y", style="sci", scilimits=(-2, 2))
    axes.invert_yaxis()


def read_instances(folder):
    """The table and its instances; None if there is none."""
    table = read_table(folder / SOURCE, ["instance", "phase", "x_body", "y_body", "cp"])
    return None if table is None else (table, instances_of(table))


def mark_sonic(axes, folder, labelled=True):
    """The pressure coefficient of sonic flow, where the case tells the Mach number."""
    case = read_case(folder)
    mach, gamma = case_value(case, "flow", "mach"), case_value(case, "flow", "gamma", 1.4)
    if not mach:
        return
    sonic = sonic_pressure_coefficient(mach, gamma)
    axes.axhline(sonic, color=COLOURS["sonic"], linewidth=0.9, linestyle=":")
    if labelled:
        axes.annotate(rf"sonic, $C_p^*$ = {sonic:.3f}", (1.0, sonic), xycoords=("axes fraction", "data"),
                      xytext=(-4, 3), textcoords="offset points", ha="right", fontsize=8, color=COLOURS["sonic"])


def draw(folder):
    found = read_instances(folder)
    if found is None:
        return None
    table, instances = found
    alike = len({len(rows) for _, rows in instances}) == 1
    periodic = len(instances) > 1 and alike
    figure, panels = plt.subplots(2 if periodic else 1, 1, figsize=(8, 8 if periodic else 5.2), sharex=True,
                                  squeeze=False, layout="constrained",
                                  height_ratios=[1.6, 1.0] if periodic else [1.0])
    axes = panels[0, 0]
    for phase, rows in instances:
        colour = phase_colour(phase / (2.0 * np.pi)) if periodic else COLOURS["flow"]
        label = label_of(phase) if periodic else "upper surface"
        plot_instance(axes, table["x_body"], table["cp"], rows, colour, label)
    axes.plot([], [], color=COLOURS["line" if periodic else "flow"], linestyle=(0, (4, 2)), label="lower surface")
    mark_sonic(axes, folder)
    axes.invert_yaxis()
    axes.set(ylabel=r"pressure coefficient $C_p$", title=title_of(folder, periodic))
    if periodic:
        draw_changes(panels[1, 0], table, instances)
    panels[-1, 0].set(xlabel="x / c, on the section at rest")
    add_key(figure, axes, instances if periodic else [])
    return figure
