"""The part of the report on an optimisation: what was asked, what was found, and whether other runs agree."""

from html import escape

from optimization import (SECTIONS, constraints_of, design_of, is_met, is_number, is_optimization, optimization_of,
                          output_text, single_objective)
from page import section, table
from read import read_result

# (quantity, how it was found, verb, where in its result.json, output of the optimiser)
REANALYSES = [
    ("V_F", "flutter runs", "flutter", ("flutter", "reduced_velocity"), "flutter_speed"),
    ("V_F", "flutter runs, linearised", "flutter", ("linear_flutter", "reduced_velocity"), "flutter_speed"),
    ("V_F", "pk runs", "pk", ("linear_flutter", "reduced_velocity"), "flutter_speed"),
    ("ω_F/ω_α", "flutter runs", "flutter", ("flutter", "frequency_ratio"), "flutter_frequency"),
    ("C_D", "steady runs", "steady", ("steady", "cd"), "drag"),
    ("C_L", "steady runs", "steady", ("steady", "cl"), "lift"),
]
COUNTS = [("iterations", "iterations"), ("evaluations", "designs"), ("failed_evaluations", "not solved"),
          ("resumed_evaluations", "of an earlier run")]


def change(before, after):
    """In %, as a text; nothing where there is no measure."""
    if not is_number(before) or not is_number(after) or abs(before) < 1e-12:
        return ""
    return f"{100.0 * (after - before) / abs(before):+.3g}"


def statement(folder):
    """One sentence on what was optimised, and how that ended."""
    told = optimization_of(folder)
    entries, _ = design_of(folder)
    parts = [f"{told.get('objective') or 'objective unknown'} over {len(entries)} variables"]
    parts += [f"{told[key]} {words}" for key, words in COUNTS if told.get(key)]
    if is_number(told.get("kkt_error")):
        parts.append(f"error of the optimality conditions {told['kkt_error']:.2g}")
    if is_number(told.get("next_root_ratio")):
        parts.append(f"next flutter root at {told['next_root_ratio']:.4g} of the lowest")
    return f"<p>{escape('; '.join(parts))}.</p>"


def output_table(folder):
    told = optimization_of(folder)
    before, after = (told.get(key) or {} for key in ("outputs_baseline", "outputs_final"))
    names = dict.fromkeys([*before, *after])
    rows = [(output_text(name)[0], name, before.get(name), after.get(name)) for name in names]
    if single_objective(folder) is None:
        rows.insert(0, ("objective", "", told.get("objective_initial"), told.get("objective_final")))
    final = "optimum" if read_result(folder).get("status") == "converged" else "best design"
    return table(["output", "name", "baseline", final, "change, %"],
                 [[*row, change(row[2], row[3])] for row in rows]) if rows else ""


def bound_text(entry):
    lower, upper = entry.get("lower"), entry.get("upper")
    if is_number(lower) and lower == upper:
        return f"= {lower:.6g}"
    return ", ".join(f"{sign} {value:.6g}" for sign, value in (("≥", lower), ("≤", upper)) if is_number(value))


def constraint_table(folder):
    rows = [[text, bound_text(entry), entry.get("initial"), entry.get("final"), entry.get("violation"),
             "met" if is_met(entry) else "violated", entry.get("multiplier")] for text, entry in constraints_of(folder)]
    return table(["constraint", "bound", "at the start", "final", "violation", "", "multiplier"], rows) if rows else ""


def bound_sentence(folder):
    """Which variables lie on a bound."""
    entries, is_final = design_of(folder)
    if not entries or not is_final:
        return ""
    texts = []
    for side in ("lower", "upper"):
        names = [str(entry["name"]) for entry in entries if entry.get("bound") == side]
        texts += [f"on the {side} bound: {', '.join(names)}"] if names else []
    return f"<p>{escape('Variables ' + '; '.join(texts) if texts else 'No variable lies on its bound')}.</p>"


def value_at(folder, path):
    """What result.json holds at a path of keys, or nothing."""
    value = read_result(folder)
    for key in path:
        try:
            value = value[key]
        except (KeyError, TypeError):
            return None
    return value if is_number(value) else None


def reanalysis_table(folder):
    """What the runs from scratch found of both sections, beside what the optimiser did."""
    told = optimization_of(folder)
    own = [told.get(key) or {} for key in ("outputs_baseline", "outputs_final")]
    rows = []
    for quantity, source, verb, path, output in REANALYSES:
        found = [value_at(folder / name / verb, path) for name in SECTIONS]
        if found == [None, None]:
            continue
        by_optimizer = [values.get(output) for values in own]
        if any(map(is_number, by_optimizer)) and not any(row[0] == quantity for row in rows):
            rows.append([quantity, "optimiser", *by_optimizer, change(*by_optimizer), "", ""])
        rows.append([quantity, source, *found, change(*found),
                     *(change(mine, other) for mine, other in zip(by_optimizer, found))])
    note = ""
    if rows:
        rows = table(["quantity", "found by", *SECTIONS, "change, %", "baseline off, %", "optimum off, %"], rows)
        note = ("<p>Analysed again from scratch, on the meshes as written; off: relative to the optimiser. The p-k "
                "method takes the section as undeflected: of one that carries lift its speed is another.</p>")
    return note + (rows or "") + unfinished(folder)


def unfinished(folder):
    """Names the runs of the comparison that did not converge."""
    found = read_result(folder).get("comparison") or {}
    texts = [f"{name}/{verb}: {entry.get('status')} {entry.get('message') or ''}".strip()
             for name, runs in found.items() for verb, entry in runs.items() if entry.get("status") != "converged"]
    return f"<p>{escape('; '.join(texts))}.</p>" if texts else ""


def optimization_section(folder):
    if not is_optimization(folder):
        return ""
    if not optimization_of(folder):
        return section("Optimisation", "<p>It has not come to a result: the figures show how far it came.</p>")
    parts = [statement(folder), output_table(folder), constraint_table(folder)]
    content = "<p></p>".join(part for part in parts if part) + bound_sentence(folder)
    return section("Optimisation", content) + "\n" + section("Optimisation checked", reanalysis_table(folder))
