"""Branch of limit cycles: energy against speed and frequency."""

import numpy as np

from curves import hermite, three_point_slopes
from read import read_result, read_table
from runs import branch_looks, limit_cycles, march_summaries
from style import COLOURS, plt

NAME = "branch"
SOURCE = "lco.csv"
CAPTION = ("Branch of limit cycles: energy against reduced velocity and against frequency. Full: stable, the speed "
           "rises with the energy; broken: unstable. Large marks: cycles asked for; small: steps between; crosses: "
           "not converged; star: flutter boundary.")
COMPARED = ("Branches of limit cycles, energy against reduced velocity and against frequency. Full: stable; broken: "
            "unstable. Squares with error bars: limit cycles found by marching in time.")
NEGLIGIBLE = 1e-3  # share of the largest energy
UNSTABLE = (0, (4, 2))
ENERGY = r"energy $E/(m b^2\omega_\alpha^2)$"


def flutter_point(folder):
    result = read_result(folder)
    for key in ("flutter", "linear_flutter"):
        point = result.get(key) or {}
        if point.get("reduced_velocity") is not None and point.get("frequency_ratio") is not None:
            return point["reduced_velocity"], point["frequency_ratio"]
    return None


def read_branch(folder):
    """Columns of the converged cycles in order of energy, those of the others apart; None if there is no branch."""
    table = read_table(folder / SOURCE, ["energy", "reduced_velocity", "frequency_ratio"])
    if table is None:
        return None
    count = len(table["energy"])
    status = table.get("status", ["converged"] * count)
    converged = np.array([status[row] == "converged" for row in range(count)])
    columns = {name: table[name] for name in ("energy", "reduced_velocity", "frequency_ratio")}
    columns["asked"] = np.nan_to_num(table.get("asked", np.ones(count)), nan=1.0) > 0.5
    slope = table.get("slope")
    columns["slope"] = slope if isinstance(slope, np.ndarray) else np.full(count, np.nan)
    order = np.nonzero(converged)[0]
    order = order[np.argsort(columns["energy"][order], kind="stable")]
    order = order[np.concatenate([[True], np.diff(columns["energy"][order]) > 0.0])[:len(order)]]
    return ({name: values[order] for name, values in columns.items()},
            {name: values[~converged] for name, values in columns.items()})


def curve(energy, values, slopes):
    """Energies, values and d/d sqrt(E) along the branch.

    Smooth in the amplitude sqrt(E), of which speed and frequency are even functions. By the slopes d/dE where these
    are given, else by those of parabolas.
    """
    amplitude = np.sqrt(energy)
    slopes = np.where(np.isfinite(slopes), 2.0 * amplitude * slopes, three_point_slopes(amplitude, values))
    slopes[amplitude == 0.0] = 0.0
    at = np.concatenate([np.linspace(a, b, 30, endpoint=False) for a, b in zip(amplitude[:-1], amplitude[1:])]
                        + [amplitude[-1:]])
    value, slope = hermite(amplitude, values, slopes, at)
    slope[at == 0.0] = slope[1]  # even: at rest the sign is that beside it
    return at**2, value, slope


def leads_to(speed, cycles):
    """Whether the smallest cycle's slope gives the speed of no energy to half its distance; without one by the next."""
    energy, velocity, slope = cycles["energy"], cycles["reduced_velocity"], cycles["slope"][0]
    if not np.isfinite(slope):
        if len(energy) == 1:
            return True
        slope = (velocity[1] - velocity[0]) / (energy[1] - energy[0])
    return abs(velocity[0] - slope * energy[0] - speed) <= 0.5 * abs(velocity[0] - speed)


def with_flutter(cycles, point):
    """The branch begins at the flutter boundary, where the energy vanishes, unless a cycle is as good as there or
    its slope leads elsewhere: the cycles of a section with freeplay do not begin there."""
    if point is None or len(cycles["energy"]) == 0 or cycles["energy"][0] <= NEGLIGIBLE * cycles["energy"][-1]:
        return cycles
    if not leads_to(point[0], cycles):
        return cycles
    first = {"energy": 0.0, "reduced_velocity": point[0], "frequency_ratio": point[1], "slope": np.nan, "asked": False}
    return {name: np.concatenate([[first[name]], values]) for name, values in cycles.items()}


def plot_branch(panels, folder, label, colour):
    """Draws a folder's branch; returns its flutter point or None, and whether a part of it is unstable."""
    cycles, failed = read_branch(folder)
    point = flutter_point(folder)
    whole, is_unstable = with_flutter(cycles, point), False
    if len(whole["energy"]) > 1:
        at, speed, slope = curve(whole["energy"], whole["reduced_velocity"], whole["slope"])
        omega = curve(whole["energy"], whole["frequency_ratio"], np.full(len(whole["energy"]), np.nan))[1]
        stable = slope >= 0.0
        is_unstable = not stable.all()
        touching = stable.copy()
        touching[1:] |= stable[:-1]
        for axes, values in zip(panels, (speed, omega)):
            axes.plot(np.where(touching, values, np.nan), at, color=colour)
            axes.plot(np.where(stable, np.nan, values), at, color=colour, linestyle=UNSTABLE)
    panels[0].plot([], [], "o-", color=colour, label=label)
    for axes, name in zip(panels, ("reduced_velocity", "frequency_ratio")):
        axes.plot(cycles[name][cycles["asked"]], cycles["energy"][cycles["asked"]], "o", color=colour, markersize=5)
        axes.plot(cycles[name][~cycles["asked"]], cycles["energy"][~cycles["asked"]], ".", color=colour, markersize=4)
        axes.plot(failed[name], failed["energy"], "x", color=COLOURS["line"], markersize=5)
    return point, is_unstable


def plot_flutter(panels, point):
    for axes, value in zip(panels, point):
        axes.plot([value], [0.0], "*", color=COLOURS["flutter"], markersize=13, zorder=6, clip_on=False)
    panels[0].plot([], [], "*", color=COLOURS["flutter"], markersize=11, linestyle="none",
                   label=rf"flutter, $V_F$ = {point[0]:.4f}")


def plot_marches(panels, summaries):
    for number, entry in enumerate(summaries):
        for axes, name, error in zip(panels, ("reduced_velocity", "frequency_ratio"), (None, "frequency_error")):
            axes.errorbar([entry[name]], [entry["energy"]], yerr=[entry.get("energy_error") or 0.0],
                          xerr=[entry.get(error) or 0.0] if error else None, fmt="s", markersize=6, capsize=3,
                          color=COLOURS["march"], markerfacecolor="none", zorder=7,
                          label="marched in time" if number == 0 else None)


def label_axes(panels):
    panels[0].set(xlabel=r"reduced velocity $V = U/(c\,\omega_\alpha)$", ylabel=ENERGY)
    panels[1].set(xlabel=r"frequency $\omega/\omega_\alpha$")
    for axes in panels:
        axes.locator_params(axis="x", nbins=6)
        axes.set_ylim(bottom=0.0)
        axes.margins(x=0.08)
        axes.ticklabel_format(axis="x", useOffset=False)


def draw_branches(folders, looks, marches):
    figure, panels = plt.subplots(1, 2, figsize=(11, 5.2), sharey=True, layout="constrained")
    plotted = [plot_branch(panels, folder, label, colour) for folder, (label, colour) in zip(folders, looks)]
    points = [point for point, _ in plotted if point]
    if any(unstable for _, unstable in plotted):
        panels[0].plot([], [], color=COLOURS["line"], linestyle=UNSTABLE, label="unstable")
    if points:
        plot_flutter(panels, points[-1])
    plot_marches(panels, marches)
    label_axes(panels)
    panels[0].legend(loc="best")
    figure.suptitle("Branch of limit cycles" if len(folders) == 1 else "Branches of limit cycles", fontsize=11)
    return figure


def draw(folder):
    if read_branch(folder) is None:
        return None
    return draw_branches([folder], branch_looks([folder]), limit_cycles([folder]))


def compare(folders):
    branches = [folder for folder in folders if read_branch(folder) is not None]
    marches = [folder for folder in folders if march_summaries(folder)]
    if not branches or len(set(branches) | set(marches)) < 2:
        return None
    return draw_branches(branches, branch_looks(branches), limit_cycles(folders))
