"""Pressure at phases of a limit cycle by both methods: time-spectral and marched in time."""

import numpy as np

from curves import series
from pressure import mark_sonic, plot_instance, read_instances
from read import read_result
from runs import branch_looks, harmonics_of, march_summaries
from style import COLOURS, panel_grid

NAME = "pressure"
SOURCE = "surface.csv"
COMPARED = ("Pressure on the section over a limit cycle. In colour the time-spectral cycle, in black the motion "
            "marched in time, at its snapshots. Full: upper surface; broken: lower.")
COLUMNS = 4
ALIKE = 0.2


def cycle_of(folder):
    """The time-spectral cycle whose pressure the folder holds: the last one."""
    cycles = read_result(folder).get("lco")
    return cycles[-1] if cycles else None


def march_of(folder):
    found = march_summaries(folder)
    return found[-1] if found and found[-1].get("verdict") == "limit-cycle" else None


def pair(folders):
    """The march and the cycle, of the most harmonics, whose energies are nearest."""
    found = []
    for march_folder in folders:
        march = march_of(march_folder)
        for folder in folders:
            cycle = cycle_of(folder)
            if not march or not cycle or not march.get("energy") or not cycle.get("energy"):
                continue
            if not (march_folder / SOURCE).is_file() or not (folder / SOURCE).is_file():
                continue
            mismatch = abs(cycle["energy"] / march["energy"] - 1.0)
            if mismatch < ALIKE:
                found.append((-(harmonics_of(folder) or 0), mismatch, folder, march_folder))
    best = min(found, default=None, key=lambda entry: entry[:2])
    return best[2:] if best else None


def compare(folders):
    chosen = pair(folders)
    if chosen is None:
        return None
    spectral, march = (read_instances(folder) for folder in chosen)
    if spectral is None or march is None or len({len(rows) for _, rows in spectral[1]}) != 1:
        return None
    (table, instances), (marched, snapshots) = spectral, march
    label, colour = branch_looks([chosen[0]])[0]
    values = np.array([table["cp"][rows] for _, rows in instances])
    body = instances[0][1]
    figure, panels, grid = panel_grid(len(snapshots), COLUMNS, (2.6, 2.1))
    for axes, (phase, rows) in zip(panels, snapshots):
        now = table["cp"].copy()
        now[body] = series(values, [phase])[0]
        plot_instance(axes, table["x_body"], now, body, colour, f"time-spectral, {label}")
        plot_instance(axes, marched["x_body"], marched["cp"], rows, COLOURS["march"], "marched in time", 0.9)
        mark_sonic(axes, chosen[0], False)
        axes.set_title(rf"$\theta$ = {round(np.degrees(phase))}°", fontsize=9)
    panels[0].invert_yaxis()
    for axes in grid[:, 0]:
        axes.set_ylabel(r"$C_p$")
    for axes in panels[-grid.shape[1]:]:
        axes.set_xlabel("x / c")
    spare = grid.size > len(panels)
    place, corner = (-1, "center") if spare else (0, "lower center")
    grid.flat[place].legend(*panels[0].get_legend_handles_labels(), loc=corner)
    energies = cycle_of(chosen[0])["energy"], march_of(chosen[1])["energy"]
    figure.suptitle(f"Pressure over the cycle: time-spectral E = {energies[0]:.3g}, marched E = {energies[1]:.3g}",
                    fontsize=11)
    return figure
