"""Reads the tables and results of a run."""

import csv
import json
from pathlib import Path

import numpy as np


TEXTS = ("stage", "zone", "block", "mode", "status", "name", "reason", "start")  # columns that may hold texts


class BadTable(Exception):
    """A file that is there but does not hold what it should."""


class Skipped(Exception):
    """A figure that cannot be drawn on this machine."""


def read_table(path, columns):
    """Columns by name: arrays of numbers (empty cells are NaN), or lists of texts where a cell is no number.

    None if there is no such file or it has no rows. `columns` must all be there.
    """
    path = Path(path)
    if not path.is_file():
        return None
    with open(path, newline="") as stream:
        reader = csv.DictReader(stream)
        rows = list(reader)
        names = reader.fieldnames or []
    missing = [name for name in columns if name not in names]
    if missing:
        raise BadTable(f"{path}: no column {', '.join(missing)}; it has {', '.join(names) or 'no columns'}")
    if not rows:
        return None
    table = {}
    for name in names:
        cells = [row[name] or "" for row in rows]
        try:
            table[name] = np.array([float(cell) if cell.strip() else np.nan for cell in cells])
        except ValueError:
            table[name] = cells
    for name in columns:
        if isinstance(table[name], list) and name not in TEXTS:
            raise BadTable(f"{path}: column {name} holds something that is not a number")
    return table


def groups(keys):
    """Row numbers of each key, in order of first appearance."""
    found = {}
    for row, key in enumerate(keys):
        found.setdefault(key, []).append(row)
    return {key: np.array(rows) for key, rows in found.items()}


def read_result(folder):
    """result.json, or nothing where it cannot be read."""
    try:
        return json.loads((Path(folder) / "result.json").read_text())
    except (OSError, ValueError):
        return {}


def read_case(folder):
    """The resolved case.toml, or nothing where it cannot be read."""
    try:
        import tomllib

        return tomllib.loads((Path(folder) / "case.toml").read_text())
    except (ImportError, OSError, ValueError):
        return {}


def case_value(case, section, key, default=None):
    return case.get(section, {}).get(key, default)
