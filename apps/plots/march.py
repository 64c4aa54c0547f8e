"""The energy of time-accurate marches, and how fast it grows at each speed."""

import numpy as np

from read import read_result
from runs import march_runs
from style import COLOURS, mark_speed, mark_zero, plt, speed_colours

NAME = "march"
SOURCE = "march.csv"
CAPTION = ("Energy of the motion marched in time, one line a speed. The broken line is the fitted growth; E grows "
           "with twice the rate σ of the motion.")
COMPARED = CAPTION
FITTED_PERIODS = 8.0  # over which the fitted growth is drawn


def growth_text(summary):
    rate, error = summary.get("growth_rate"), summary.get("growth_rate_error")
    if rate is None:
        return ""
    return rf", $\sigma$ = {rate:.1e}" + (rf" $\pm$ {error:.0e}" if error else "")


def label_of(run):
    summary = run["summary"]
    verdict = summary.get("verdict", "")
    text = f"V = {run['speed']:.4f}" + (f", {verdict.replace('-', ' ')}" if verdict else "")
    if verdict != "limit-cycle":
        return text + growth_text(summary)
    return text + (f", E = {summary['energy']:.3g}" if summary.get("energy") else "")


def plot_fit(axes, run):
    """The exponential e^(2 sigma t) through the mean energy of the last periods."""
    summary = run["summary"]
    rate, omega = summary.get("growth_rate"), summary.get("frequency_ratio")
    if rate is None or not omega or summary.get("verdict") not in ("grows", "decays"):
        return
    time, energy = run["time"], run["energy"]
    rows = (time >= time[-1] - FITTED_PERIODS * 2.0 * np.pi / omega) & (energy > 0.0)
    if rows.sum() < 3:
        return
    centre = np.mean(np.log(energy[rows]) - 2.0 * rate * time[rows])
    ends = np.array([time[rows][0], time[-1]])
    axes.plot(ends, np.exp(centre + 2.0 * rate * ends), color=COLOURS["march"], linestyle=(0, (4, 2)), zorder=5)


def plot_energies(axes, runs):
    for run, colour in zip(runs, speed_colours(len(runs))):
        energy = np.where(run["energy"] > 0.0, run["energy"], np.nan)
        axes.semilogy(run["time"], energy, color=colour, linewidth=1.0, label=label_of(run))
        plot_fit(axes, run)
    axes.set(xlabel=r"time $\omega_\alpha t$", ylabel=r"energy $E/(m b^2\omega_\alpha^2)$",
             title="Energy of the marched motion")
    axes.margins(x=0.01)
    lowest, highest = axes.get_ylim()
    axes.set_ylim(10.0 ** np.floor(np.log10(lowest)), 10.0 ** np.ceil(np.log10(highest)))
    if len(runs) <= 12:
        beside = {"loc": "upper left", "bbox_to_anchor": (1.0, 1.0)} if len(runs) > 4 else {"loc": "best"}
        axes.legend(**beside)


def plot_growth(axes, runs, flutter):
    """sigma against V of the small motions; of a limit cycle it says nothing."""
    small = [run for run in runs if run["summary"].get("verdict") in ("grows", "decays")]
    for run in small:
        summary = run["summary"]
        axes.errorbar([run["speed"]], [summary["growth_rate"]], yerr=[summary.get("growth_rate_error") or 0.0], fmt="o",
                      markersize=5, capsize=3, color=COLOURS["march"])
    mark_zero(axes)
    if flutter.get("reduced_velocity") is not None:
        speed, error = flutter["reduced_velocity"], flutter.get("reduced_velocity_error")
        mark_speed(axes, speed)
        axes.plot([speed], [0.0], "*", color=COLOURS["flutter"], markersize=13, zorder=5,
                  label=rf"flutter, $V_F$ = {speed:.4f}" + (rf" $\pm$ {error:.0e}" if error else ""))
        axes.legend(loc="best")
    axes.margins(0.1)
    axes.ticklabel_format(axis="y", style="sci", scilimits=(-2, 2))
    axes.set(xlabel=r"reduced velocity $V = U/(c\,\omega_\alpha)$", ylabel=r"growth rate $\sigma/\omega_\alpha$")


def draw_runs(runs, flutter):
    small = [run for run in runs if run["summary"].get("verdict") in ("grows", "decays")]
    with_growth = len(small) > 1
    figure, panels = plt.subplots(2 if with_growth else 1, 1, figsize=(9.5, 8.5 if with_growth else 5.2), squeeze=False,
                                  height_ratios=[1.5, 1.0] if with_growth else [1.0], layout="constrained")
    plot_energies(panels[0, 0], sorted(runs, key=lambda run: run["speed"]))
    if with_growth:
        plot_growth(panels[1, 0], small, flutter)
    return figure


def flutter_of(folder):
    """The flutter point that marches found."""
    result = read_result(folder)
    return result.get("flutter") or {} if result.get("command") == "march" else {}


def draw(folder):
    runs = march_runs(folder)
    return draw_runs(runs, flutter_of(folder)) if runs else None


def compare(folders):
    runs = [run for folder in folders for run in march_runs(folder)]
    if sum(bool(march_runs(folder)) for folder in folders) < 2:
        return None
    found = [flutter_of(folder) for folder in folders if flutter_of(folder)]
    return draw_runs(runs, found[-1] if found else {})
