#!/usr/bin/env python3
"""Draws what a wingbeat run left in its folder, as PNG files in that folder.

    plot.py DIR

Reads, where present:
    mesh.csv     zone, i, j, x, y                             mesh near the section
    surface.csv  instance, phase, x, y, cp (instance, phase optional)
                                                              pressure on the wall
    pk.csv       branch, reduced_velocity, frequency, damping p-k curves
    history.csv  stage, iteration, then residuals             convergence
    result.json                                               flutter speed, marked in the p-k curves
"""

import csv
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def read_table(path):
    """Columns by name: numbers where every cell of the column is one, else texts."""
    with open(path, newline="") as stream:
        rows = list(csv.DictReader(stream))
    columns = {}
    for name in rows[0] if rows else []:
        cells = [row[name] for row in rows]
        try:
            columns[name] = [float(cell) if cell else float("nan") for cell in cells]
        except ValueError:
            columns[name] = cells
    return columns


def groups(keys):
    """Row numbers of each key, in order of first appearance."""
    found = {}
    for row, key in enumerate(keys):
        found.setdefault(key, []).append(row)
    return found


def pick(column, rows):
    return [column[row] for row in rows]


def draw_mesh(folder):
    table = read_table(folder / "mesh.csv")
    if not table:
        return None
    figure, axes = plt.subplots(figsize=(9, 6))
    # A grid line is broken where the table leaves out nodes far from the section.
    for line, along in (("j", "i"), ("i", "j")):
        for rows in groups(zip(table["zone"], table[line])).values():
            x, y, last = [], [], None
            for row in rows:
                if last is not None and table[along][row] != last + 1:
                    x.append(float("nan"))
                    y.append(float("nan"))
                x.append(table["x"][row])
                y.append(table["y"][row])
                last = table[along][row]
            axes.plot(x, y, color="0.35", linewidth=0.4)
    axes.set(aspect="equal", xlim=(-0.3, 1.3), ylim=(-0.5, 0.5), xlabel="x / c", ylabel="y / c",
             title="Mesh near the section")
    return figure


def draw_pressure(folder):
    table = read_table(folder / "surface.csv")
    if not table:
        return None
    instances = table.get("instance", [0.0] * len(table["x"]))
    figure, axes = plt.subplots(figsize=(8, 6))
    for instance, rows in groups(instances).items():
        label = f"instance {instance:.0f}"
        if "phase" in table:
            label += f", phase {table['phase'][rows[0]]:.2f}"
        axes.plot(pick(table["x"], rows), pick(table["cp"], rows), ".-", markersize=2, linewidth=0.8, label=label)
    axes.invert_yaxis()
    axes.set(xlabel="x / c", ylabel="pressure coefficient", title="Pressure on the section")
    if len(set(instances)) > 1:
        axes.legend()
    return figure


def flutter_speed(folder):
    try:
        result = json.loads((folder / "result.json").read_text())
    except (OSError, ValueError):
        return None
    for name in ("flutter", "linear_flutter"):
        speed = (result.get(name) or {}).get("reduced_velocity")
        if speed is not None:
            return speed
    return None


def draw_pk(folder):
    table = read_table(folder / "pk.csv")
    if not table:
        return None
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(8, 8), sharex=True)
    for branch, rows in groups(table["branch"]).items():
        speed = pick(table["reduced_velocity"], rows)
        upper.plot(speed, pick(table["frequency"], rows), ".-", label=f"branch {branch:.0f}")
        lower.plot(speed, pick(table["damping"], rows), ".-")
    lower.axhline(0.0, color="0.5", linewidth=0.8)
    speed = flutter_speed(folder)
    if speed is not None:
        for axes in (upper, lower):
            axes.axvline(speed, color="0.5", linestyle="--", linewidth=0.8)
        lower.annotate(f"V = {speed:.4f}", (speed, 0.0), xytext=(4, 6), textcoords="offset points")
    upper.set(ylabel=r"$\omega/\omega_\alpha$", title="Frequency and damping")
    lower.set(xlabel=r"reduced velocity $U/(c\,\omega_\alpha)$", ylabel="damping g (> 0: growing)")
    upper.legend()
    return figure


def draw_history(folder):
    table = read_table(folder / "history.csv")
    residuals = [name for name, cells in table.items()
                 if "residual" in name or name in ("flow", "structure", "phase", "energy")]
    if not residuals:
        return None
    stages = groups(table.get("stage", [""] * len(table[residuals[0]])))
    figure, panels = plt.subplots(1, len(stages), figsize=(6 * len(stages), 5), squeeze=False)
    for axes, (stage, rows) in zip(panels[0], stages.items()):
        for name in residuals:
            values = pick(table[name], rows)
            shown = [abs(value) if isinstance(value, float) and value != 0.0 else float("nan") for value in values]
            if any(value == value for value in shown):
                axes.semilogy(range(len(rows)), shown, ".-", label=name)
        axes.set(xlabel="iteration", ylabel="residual", title=f"Convergence {stage}".strip())
        if axes.lines:
            axes.legend()
    return figure


DRAWINGS = {"mesh": draw_mesh, "surface": draw_pressure, "pk": draw_pk, "history": draw_history}


def main(arguments):
    if len(arguments) != 1:
        sys.exit(__doc__)
    folder = Path(arguments[0])
    drawn = 0
    for name, draw in DRAWINGS.items():
        source = folder / f"{name}.csv"
        if not source.is_file():
            continue
        try:
            figure = draw(folder)
        except KeyError as column:
            sys.exit(f"plot: {source}: no column {column}")
        if figure is None:
            continue
        target = folder / f"{name}.png"
        figure.tight_layout()
        figure.savefig(target, dpi=150)
        plt.close(figure)
        print(target)
        drawn += 1
    if drawn == 0:
        names = ", ".join(f"{name}.csv" for name in DRAWINGS)
        sys.exit(f"plot: {folder}: nothing to draw; none of {names} is there or holds rows")


if __name__ == "__main__":
    main(sys.argv[1:])
