"""Velocity against displacement of the limit cycles: plunge and pitch."""

import numpy as np

from curves import series
from read import groups, read_table
from runs import branch_looks, harmonics_of, last_period, march_runs
from style import COLOURS, energy_colours, plt

NAME = "phase_portrait"
SOURCE = "cycles.csv"
CAPTION = ("Phase portraits of plunge and pitch. Time-spectral cycles: the harmonics as a curve, the instances as "
           "marks. Marches: the last period, in black.")
COMPARED = CAPTION
MOTION = ["plunge", "plunge_rate", "pitch_deg", "pitch_rate"]
MOST_IN_LEGEND = 6
BESIDE = (0, (3, 1.5))  # line of a march, which leaves the cycle below it visible
ALIKE = 0.2  # relative difference of energies up to which a cycle and a march are compared


def read_cycles(folder):
    """{point: (energy or None, columns)}; of a branch only what was asked for, if anything."""
    table = read_table(folder / SOURCE, ["point", "instance", "phase", *MOTION])
    if table is None:
        return {}
    branch = read_table(folder / "lco.csv", ["energy"])
    energies, asked = {}, {}
    if branch is not None:
        numbers = branch.get("point", np.arange(1, len(branch["energy"]) + 1))
        energies = dict(zip(numbers, branch["energy"]))
        asked = dict(zip(numbers, branch.get("asked", np.ones(len(numbers)))))
    cycles = {point: (energies.get(point), {name: table[name][rows] for name in MOTION})
              for point, rows in groups(table["point"]).items()}
    wanted = {point: cycle for point, cycle in cycles.items() if asked.get(point, 1.0) > 0.5}
    return wanted or cycles


def frame():
    figure, panels = plt.subplots(1, 2, figsize=(11, 5.2), layout="constrained")
    panels[0].set(xlabel=r"plunge $h/b$, positive down", ylabel=r"plunge rate $\dot h/(b\,\omega_\alpha)$")
    panels[1].set(xlabel=r"pitch $\alpha$, deg", ylabel=r"pitch rate $\dot\alpha/\omega_\alpha$, deg")
    return figure, panels


def plot_motion(panels, columns, **style):
    """Rates of pitch are in radians, as its angle is in degrees they are drawn in these."""
    label = style.pop("label", None)
    panels[0].plot(columns["plunge"], columns["plunge_rate"], label=label, **style)
    panels[1].plot(columns["pitch_deg"], np.degrees(columns["pitch_rate"]), **style)


def plot_cycle(panels, cycle, label, colour):
    theta = np.linspace(0.0, 2.0 * np.pi, 361)
    plot_motion(panels, {name: series(values, theta) for name, values in cycle.items()}, color=colour, label=label)
    plot_motion(panels, cycle, color=colour, marker="o", markersize=3.5, linestyle="none")


def plot_march(panels, run, label, dashes=BESIDE):
    rows = last_period(run)
    plot_motion(panels, {name: run[name][rows] for name in MOTION}, color=COLOURS["march"], linewidth=1.1,
                linestyle=dashes, label=label, zorder=5)


def settled(folder):
    return [run for run in march_runs(folder) if run["summary"].get("verdict") == "limit-cycle"]


def energy_text(energy):
    return f"E = {energy:.3g}" if energy is not None else ""


def draw(folder):
    cycles, marches = read_cycles(folder), settled(folder)
    if not cycles and not marches:
        return None
    figure, panels = frame()
    ordered = sorted(cycles.items(), key=lambda item: item[1][0] if item[1][0] is not None else item[0])
    colours = energy_colours(len(ordered)) if len(ordered) > 1 else [COLOURS["time-spectral"]]
    for number, ((point, (energy, cycle)), colour) in enumerate(zip(ordered, colours)):
        labelled = len(ordered) <= MOST_IN_LEGEND or number in (0, len(ordered) - 1)
        plot_cycle(panels, cycle, (energy_text(energy) or f"cycle {point:g}") if labelled else None, colour)
    dashes = BESIDE if cycles else "-"
    for run in marches:
        plot_march(panels, run, f"marched, {energy_text(run['summary'].get('energy'))}", dashes)
    if len(ordered) + len(marches) > 1:
        panels[1].legend(*panels[0].get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(1.0, 1.0))
    harmonics = harmonics_of(folder)
    figure.suptitle("Phase portraits" + (f", {harmonics} harmonics" if cycles and harmonics else ""), fontsize=11)
    return figure


def nearest(cycles, energy):
    """The cycle whose energy is nearest, if it is near at all."""
    known = [cycle for cycle in cycles.values() if cycle[0] and abs(cycle[0] / energy - 1.0) < ALIKE]
    return min(known, key=lambda cycle: abs(cycle[0] / energy - 1.0), default=None)


def common_energy(branches, marches):
    """The largest energy of a march, else of a cycle, that the most folders have."""
    candidates = [run["summary"]["energy"] for run in marches if run["summary"].get("energy")]
    candidates = [energy for energy in candidates if any(nearest(cycles, energy) for cycles in branches)]
    if not candidates:
        candidates = [cycle[0] for cycles in branches for cycle in cycles.values() if cycle[0]]
    return max(candidates, default=None,
               key=lambda energy: (sum(nearest(cycles, energy) is not None for cycles in branches), energy))


def compare(folders):
    found = [(folder, read_cycles(folder)) for folder in folders]
    found = [(folder, cycles) for folder, cycles in found if cycles]
    marches = [run for folder in folders for run in settled(folder)]
    energy = common_energy([cycles for _, cycles in found], marches)
    if energy is None:
        return None
    shown = [(look, nearest(cycles, energy)) for (_, cycles), look in
             zip(found, branch_looks([folder for folder, _ in found]))]
    shown = [(look, cycle) for look, cycle in shown if cycle is not None]
    beside = [run for run in marches if abs((run["summary"].get("energy") or np.inf) / energy - 1.0) < ALIKE]
    if len(shown) + len(beside) < 2:
        return None
    figure, panels = frame()
    for (label, colour), (of_cycle, cycle) in shown:
        plot_cycle(panels, cycle, f"{label}, {energy_text(of_cycle)}", colour)
    for run in beside:
        plot_march(panels, run, f"marched, {energy_text(run['summary']['energy'])}")
    panels[0].legend(loc="center")  # inside the loops
    figure.suptitle(f"Phase portraits near E = {energy:.3g}", fontsize=11)
    return figure
