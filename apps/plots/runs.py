"""Runs beside each other: the sub-folders of a folder, and what tells them apart."""

import re
from pathlib import Path

import numpy as np

from read import case_value, groups, read_case, read_result, read_table
from style import FURTHER, harmonic_colour

MARCH_COLUMNS = ["time", "reduced_velocity", "energy", "plunge", "pitch_deg", "plunge_rate", "pitch_rate"]


def natural(path):
    """Sorts harmonics-2 before harmonics-10."""
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", Path(path).name)]


def runs_in(folder):
    """The sub-folders that hold a run, but for what a run before left of itself in earlier/."""
    found = (path.parent for path in Path(folder).glob("*/result.json") if path.parent.name != "earlier")
    return sorted(found, key=natural)


def harmonics_of(folder):
    return case_value(read_case(folder), "time", "harmonics")


def branch_looks(folders):
    """(label, colour) of each folder's time-spectral cycles: by its harmonics where these tell the folders apart."""
    counts = [harmonics_of(folder) for folder in folders]
    if all(counts) and len(set(counts)) == len(counts):
        return [(rf"$N_H$ = {count}", harmonic_colour(count)) for count in counts]
    return [(Path(folder).name, FURTHER[number % len(FURTHER)]) for number, folder in enumerate(folders)]


def march_summaries(folder):
    """What result.json says of each march, in the order of march.csv."""
    result = read_result(folder)
    found = result.get("marches") or [result.get("march")]
    return [entry for entry in found if entry]


def march_runs(folder):
    """One dictionary a march: the columns of march.csv between restarts of its time, and "summary"."""
    table = read_table(folder / "march.csv", MARCH_COLUMNS)
    if table is None:
        return []
    restarts = (np.diff(table["time"]) <= 0.0) | (np.diff(table["reduced_velocity"]) != 0.0)
    number = np.concatenate([[0], np.cumsum(restarts)])
    summaries = march_summaries(folder)
    runs = []
    for rows in groups(number).values():
        run = {name: values[rows] for name, values in table.items() if not isinstance(values, list)}
        run["summary"] = summaries[len(runs)] if len(runs) < len(summaries) else {}
        run["speed"] = run["reduced_velocity"][0]
        runs.append(run)
    return runs


def last_period(run):
    """Rows of a march's last period, one more than a period long so that the curve closes."""
    omega = run["summary"].get("frequency_ratio")
    if not omega:
        return None
    time = run["time"]
    rows = np.nonzero(time >= time[-1] - 2.0 * np.pi / omega)[0]
    return np.arange(max(rows[0] - 1, 0), len(time))


def limit_cycles(folders):
    """Summaries of the marches that ended in a limit cycle."""
    return [entry for folder in folders for entry in march_summaries(folder)
            if entry.get("verdict") == "limit-cycle" and entry.get("energy") is not None]
