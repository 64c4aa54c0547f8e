"""Convergence of the speed of every cycle over the iterations."""

import re

import numpy as np

from read import groups, read_result, read_table
from style import COLOURS, energy_colours, plt

NAME = "speed_convergence"
SOURCE = "history.csv"
CAPTION = ("Speed of every cycle over its iterations (Newton steps, or structural steps of the staggered iteration): "
           "the value, and its distance from the last one.")
MOST_SHOWN = 8
ALIKE = 0.01  # energies in names of stages have three digits


def asked_energies(folder):
    """Energies that the run was asked for, if lco.csv tells them from the steps between."""
    table = read_table(folder / "lco.csv", ["energy"])
    if table is None or "asked" not in table:
        return None
    return table["energy"][table["asked"] > 0.5]


def energy_of(folder, stage):
    """E_0 of a stage: in its name, or by its number in lco.csv, or that of the flutter boundary; None if untold."""
    named = re.search(r"E_0 ([-+.\deE]+)", stage)
    if named:
        return float(named.group(1))
    number, table = re.match(r"cycle (\d+)", stage), read_table(folder / "lco.csv", ["energy"])
    if number and table is not None and int(number.group(1)) <= len(table["energy"]):
        return float(table["energy"][int(number.group(1)) - 1])
    return (read_result(folder).get("flutter") or {}).get("energy") if stage.startswith("flutter") else None


def shown_stages(folder, table):
    """(label, energy, rows) of the stages that iterate on a speed, in order of energy; at most MOST_SHOWN."""
    stages, asked = [], asked_energies(folder)
    for stage, rows in groups(table["stage"]).items():
        rows = rows[np.isfinite(table["reduced_velocity"][rows])]
        if len(rows) < 2:
            continue
        energy = energy_of(folder, stage)
        label = rf"$E_0$ = {energy:.3g}" if energy else stage
        wanted = asked is None or energy is None or np.any(np.abs(asked / energy - 1.0) < ALIKE)
        stages.append((label, energy or np.inf, rows, wanted))
    chosen = [entry for entry in stages if entry[3]] or stages
    chosen.sort(key=lambda entry: entry[1])
    if len(chosen) > MOST_SHOWN:
        chosen = [chosen[i] for i in np.unique(np.linspace(0, len(chosen) - 1, MOST_SHOWN).round().astype(int))]
    return [entry[:3] for entry in chosen]


def draw(folder):
    table = read_table(folder / SOURCE, ["stage", "iteration", "flow"])
    if table is None or not isinstance(table.get("reduced_velocity"), np.ndarray):
        return None
    stages = shown_stages(folder, table)
    if not stages:
        return None
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    colours = energy_colours(len(stages)) if len(stages) > 1 else [COLOURS["energy"]]
    for (label, _, rows), colour in zip(stages, colours):
        speed = table["reduced_velocity"][rows]
        style = {"color": colour, "marker": "o", "markersize": 3.5 if len(rows) < 30 else 0}
        left.plot(np.arange(len(rows)), speed, label=label, **style)
        distance = np.abs(speed[:-1] / speed[-1] - 1.0)
        right.semilogy(np.arange(len(rows) - 1), np.where(distance > 0.0, distance, np.nan), **style)
    left.set(xlabel="iteration", ylabel=r"reduced velocity $V = U/(c\,\omega_\alpha)$")
    left.ticklabel_format(axis="y", useOffset=False)
    right.set(xlabel="iteration", ylabel=r"$|V/V_{\mathrm{last}} - 1|$")
    for axes in (left, right):
        axes.xaxis.set_major_locator(plt.MaxNLocator(integer=True))
    right.legend(*left.get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(1.0, 1.0))
    figure.suptitle("Convergence of the speed", fontsize=11)
    return figure
