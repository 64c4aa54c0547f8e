"""Branches of limit cycles of the section before and after an optimisation."""

import numpy as np

from branch import SOURCE as BRANCH
from branch import (ENERGY, UNSTABLE, curve, flutter_point, label_axes, plot_branch, plot_flutter, read_branch,
                    with_flutter)
from optimization import SOURCE, compared_runs
from read import read_table
from style import COLOURS, plt

__all__ = ["CAPTION", "NAME", "SOURCE", "draw"]

NAME = "optimization_branches"
CAPTION = ("Branches of limit cycles of the undeformed and the optimised section: energy against reduced velocity and "
           "frequency, and pitch amplitude against reduced velocity; full: stable, broken: unstable.")
PITCH = "pitch_amplitude_deg"


def pitch_per_amplitude(table, cycles):
    """|alpha|/sqrt(E) of the cycles, even in the amplitude as speed and frequency are; at rest that of the next."""
    order = np.argsort(table["energy"])
    energy, pitch = table["energy"][order], table[PITCH][order]
    known = (energy > 0.0) & np.isfinite(pitch)
    return np.interp(cycles["energy"], energy[known], pitch[known] / np.sqrt(energy[known]))


def plot_pitch(axes, run, colour):
    table = read_table(run / BRANCH, ["energy", PITCH])
    cycles = with_flutter(read_branch(run)[0], flutter_point(run))
    if len(cycles["energy"]) < 2:
        return
    at, speed, slope = curve(cycles["energy"], cycles["reduced_velocity"], cycles["slope"])
    share = pitch_per_amplitude(table, cycles)
    pitch = curve(cycles["energy"], share, np.full(len(share), np.nan))[1] * np.sqrt(at)
    stable = slope >= 0.0
    touching = stable.copy()
    touching[1:] |= stable[:-1]
    axes.plot(np.where(touching, speed, np.nan), pitch, color=colour)
    axes.plot(np.where(stable, np.nan, speed), pitch, color=colour, linestyle=UNSTABLE)
    marks = share * np.sqrt(cycles["energy"])
    for rows, mark, size in ((cycles["asked"], "o", 5), (~cycles["asked"], ".", 4)):
        axes.plot(cycles["reduced_velocity"][rows], marks[rows], mark, color=colour, markersize=size)


def draw(folder):
    runs = compared_runs(folder, "lco", BRANCH)
    if runs is None or any(read_branch(run) is None for _, run in runs):
        return None
    figure, panels = plt.subplots(1, 3, figsize=(13, 5.0), layout="constrained")
    plotted = [plot_branch(panels[:2], run, name, COLOURS[name]) for name, run in runs]
    for name, run in runs:
        plot_pitch(panels[2], run, COLOURS[name])
    if any(unstable for _, unstable in plotted):
        panels[0].plot([], [], color=COLOURS["line"], linestyle=UNSTABLE, label="unstable")
    for point in (point for point, _ in plotted if point):
        plot_flutter(panels, (*point, point[0]))
    label_axes(panels[:2])
    panels[1].set_ylabel(ENERGY)
    panels[2].set(xlabel=panels[0].get_xlabel(), ylabel="pitch amplitude, deg", ylim=(0.0, None))
    panels[2].margins(x=0.08)
    panels[2].locator_params(axis="x", nbins=6)
    panels[0].legend(loc="best")
    figure.suptitle("Branches of limit cycles, baseline and optimum", fontsize=11)
    return figure
