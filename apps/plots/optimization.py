"""What `wingbeat optimize` left: its statement, its iterations, its design, and the runs that compare two sections."""

import json
import re

import numpy as np

from gradient import OBJECTIVES
from read import Skipped, read_result, read_table

SOURCE = "optimization.csv"
RECORD = "evaluations.jsonl"
SECTIONS = ("baseline", "optimum")
FEASIBLE = 1e-4  # constraints are met to this, over their scales
NEGLIGIBLE = 1e-6  # a baseline smaller than this is no measure: a lift of zero
MEASURES = ["violation", "kkt_error", "is_restoring"]
OUTPUTS = {
    **OBJECTIVES,
    "least_lco_speed": ("least speed of the cycles", r"V_\mathrm{min}"),
    "area": ("area of the section", "A/c^2"),
    "thickness": ("greatest thickness", "t/c"),
    "leading_edge_radius": ("leading-edge radius", "r_{LE}/c"),
}
UNITS = {"lco_amplitude": "deg"}


def is_optimization(folder):
    return (folder / SOURCE).is_file() or (folder / RECORD).is_file() or bool(optimization_of(folder))


def optimization_of(folder):
    """What result.json says of the optimisation, or nothing."""
    found = read_result(folder).get("optimization")
    return found if isinstance(found, dict) else {}


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and np.isfinite(value)


def output_text(name):
    """(words, symbol without $) of an output; "flutter_speed 2" is that of a further root."""
    kind, _, number = name.partition(" ")
    words, symbol = OUTPUTS.get(kind, (kind.replace("_", " "), ""))
    symbol = symbol[1:-1] if symbol.startswith("(") and symbol.endswith(")") else symbol
    return (f"{words}, root {number}", rf"{symbol}^{{({number})}}") if number else (words, symbol)


def output_label(name):
    words, symbol = output_text(name)
    return f"{words} ${symbol}$" if symbol else words


def constraints_of(folder):
    """(text, entry) of every constraint."""
    found = optimization_of(folder).get("constraints")
    return [(text, entry) for text, entry in (found or {}).items() if isinstance(entry, dict)]


def bounds_of(folder, output):
    """(sign, value) of every bound of an output."""
    bounds = []
    for _, entry in constraints_of(folder):
        if entry.get("output") != output:
            continue
        lower, upper = entry.get("lower"), entry.get("upper")
        if is_number(lower) and lower == upper:
            bounds.append(("=", lower))
        else:
            bounds += [(sign, value) for sign, value in (("≥", lower), ("≤", upper)) if is_number(value)]
    return bounds


def is_met(entry):
    return not (is_number(entry.get("violation")) and entry["violation"] > FEASIBLE)


def read_record(folder):
    """The lines of the record of evaluations; one that a stop cut off is left out."""
    path = folder / RECORD
    lines = []
    if path.is_file():
        for text in path.read_text(errors="replace").splitlines():
            try:
                line = json.loads(text)
            except ValueError:
                continue
            if isinstance(line, dict):
                lines.append(line)
    return lines


def by_design(lines, kind, key):
    """What the lines of a kind hold under a key, by their designs; of outputs those of all lines of a design."""
    found = {}
    for line in lines:
        if line.get("kind") != kind or key not in line:
            continue
        design = tuple(line.get("design") or [])
        known = found.get(design)
        found[design] = {**known, **line[key]} if isinstance(known, dict) else line[key]
    return found


def iteration_lines(lines):
    return [line for line in lines if line.get("kind") == "iteration" and is_number(line.get("iteration"))]


def places(iteration):
    """Iterations as they were made: a count that falls back goes on from where it was."""
    iteration = np.asarray(iteration, dtype=float)
    return iteration - np.concatenate([[0.0], np.cumsum(np.minimum(np.diff(iteration), 0.0))])[:len(iteration)]


def restarts(iteration):
    """Rows at which the optimiser began anew."""
    return np.nonzero(np.diff(iteration) <= 0.0)[0] + 1


def number_or_nan(value):
    return float(value) if is_number(value) or isinstance(value, bool) else np.nan


def read_table_of_iterations(folder):
    """(columns, names of outputs, names of variables) of optimization.csv; None if it has no rows."""
    table = read_table(folder / SOURCE, ["iteration", "objective", *MEASURES])
    if table is None:
        return None
    names = list(table)
    outputs = names[names.index("objective") + 1:names.index("violation")]
    variables = names[names.index("seconds") + 1:] if "seconds" in names else []
    rows = np.isfinite(table["iteration"])
    columns = {name: values[rows] for name, values in table.items() if isinstance(values, np.ndarray)}
    return columns, [name for name in outputs if name in columns], [name for name in variables if name in columns]


def read_history(folder):
    """Columns of all iterations, and the names of the outputs among them; None if there are none.

    optimization.csv begins anew whenever the optimiser does; what was before is in the record.
    """
    found = read_table_of_iterations(folder)
    lines = read_record(folder)
    iterations = iteration_lines(lines)
    rows = len(found[0]["iteration"]) if found else 0
    earlier = iterations[:max(len(iterations) - rows, 0)]
    if not rows and not earlier:
        return None
    values = by_design(lines, "values", "outputs")
    before = [values.get(tuple(line.get("design") or []), {}) for line in earlier]
    outputs = list(found[1]) if found else []
    outputs += [name for name in dict.fromkeys(name for entry in before for name in entry) if name not in outputs]
    history = {}
    for name in ("iteration", "objective", *MEASURES, *outputs):
        own = [entry.get(name) for entry in (before if name in outputs else earlier)]
        later = found[0].get(name, np.full(rows, np.nan)) if found else []
        history[name] = np.concatenate([[number_or_nan(value) for value in own], later])
    return history, outputs


def baseline_value(folder, history, output):
    """Value of an output for the undeformed section; without a result that of the first iteration."""
    value = (optimization_of(folder).get("outputs_baseline") or {}).get(output)
    if is_number(value):
        return value
    known = history[output][np.isfinite(history[output])]
    return known[0] if len(known) else np.nan


def single_objective(folder):
    """The output that is the objective, or None for a sum of several."""
    words = re.sub(r"^(maximi[sz]e|minimi[sz]e)\s+", "", str(optimization_of(folder).get("objective") or "").strip())
    return words if words in OUTPUTS else None


def sense_of(folder):
    text = str(optimization_of(folder).get("objective") or "")
    return "maximised" if text.startswith("max") else "minimised" if text.startswith("min") else ""


def design_of(folder):
    """(entries of the variables, whether they are the final ones): else those of the last iteration."""
    entries = [entry for entry in optimization_of(folder).get("design") or []
               if isinstance(entry, dict) and is_number(entry.get("value"))]
    if entries:
        return entries, True
    found = read_table_of_iterations(folder)
    if not found or not len(found[0]["iteration"]):
        return [], False
    return [{"name": name, "value": found[0][name][-1]} for name in found[2] if np.isfinite(found[0][name][-1])], False


def compared_runs(folder, verb, file):
    """(section, folder) of the runs of a verb for both sections; None where nothing was optimised here."""
    if not is_optimization(folder):
        return None
    runs = [(name, folder / name / verb) for name in SECTIONS]
    missing = [f"{name}/{verb}/{file}" for name, run in runs if not (run / file).is_file()]
    if missing:
        raise Skipped(f"no {' and no '.join(missing)}; optimize.compare = [\"{verb}\"] makes both runs")
    return runs
