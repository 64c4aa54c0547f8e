"""What a sweep found against its parameters: branches of flutter roots, or contours for two parameters."""

import numpy as np

from read import BadTable, groups, read_table
from style import COLOURS, LINES

SOURCE = "sweep.csv"
LABELS = {
    "flow.mach": "Mach number", "flow.angle_of_attack_deg": "angle of attack, deg",
    "structure.mass_ratio": r"mass ratio $\mu$", "structure.frequency_ratio": r"$\omega_h/\omega_\alpha$",
    "structure.static_unbalance": r"static unbalance $x_\alpha$", "structure.elastic_axis": "elastic axis $a$",
    "flutter.energy": r"energy $E_0$", "time.harmonics": "harmonics $N_H$",
    "reduced_velocity": r"reduced velocity $V = U/(c\,\omega_\alpha)$",
    "speed_index": r"speed index $V^* = 2V/\sqrt{\mu}$", "frequency_ratio": r"$\omega/\omega_\alpha$",
    "cl": "$C_L$", "cd": "$C_D$", "cm": "$C_M$",
}
# What is shown, of a table's columns: the first two or three that are there.
SHOWN = [("speed_index", "frequency_ratio"), ("reduced_velocity", "frequency_ratio"), ("cl", "cd", "cm"),
         ("cl_1_re", "cl_1_im"), ("value",)]


def label(name):
    return LABELS.get(name, name)


def read_sweep(folder):
    """(keys, table, rows that were solved) of sweep.csv; None if there is none.

    Columns up to the speed or the status are keys.
    """
    table = read_table(folder / SOURCE, ["status", "seconds"])
    if table is None:
        return None
    names = list(table)
    keys = names[:min(names.index(name) for name in ("reduced_velocity", "status") if name in names)]
    if not keys:
        raise BadTable(f"{folder / SOURCE}: no column of a parameter")
    solved = np.array([status == "converged" for status in table["status"]])
    return keys, table, solved


def columns_of(table):
    for columns in SHOWN:
        if all(isinstance(table.get(name), np.ndarray) for name in columns):
            return columns
    return ()


def swept_numbers(folder, count):
    """(keys, table, solved, columns to show) of a sweep over `count` numbers; None of any other."""
    found = read_sweep(folder)
    if found is None:
        return None
    keys, table, solved = found
    columns = columns_of(table)
    if len(keys) != count or not columns or not all(isinstance(table[key], np.ndarray) for key in keys):
        return None
    return keys, table, solved, columns


def branches_of(table, rows):
    """Rows of each branch, by its number; all of them where there are none."""
    if not isinstance(table.get("branch"), np.ndarray):
        return {1: rows}
    return {int(number): rows[found] for number, found in groups(table["branch"][rows]).items()}


def mark_failed(axes, places):
    for place in places:
        axes.axvline(place, color=COLOURS["bound"], linewidth=0.8, linestyle=LINES[2], zorder=1)


def switches(places, lowest):
    """Places between which the lowest root changes its branch: (before, after)."""
    return [(places[i], places[i + 1]) for i in range(len(places) - 1) if lowest[i] != lowest[i + 1]]


def lowest_of(table, key, branches):
    """(places, branch of the lowest root there) in order of the parameter."""
    best = {}
    for number, rows in branches.items():
        for row in rows:
            place, speed = table[key][row], table["reduced_velocity"][row]
            if place not in best or speed < best[place][0]:
                best[place] = (speed, number)
    places = sorted(best)
    return places, [best[place][1] for place in places]
