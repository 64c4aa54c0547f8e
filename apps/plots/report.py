"""DIR/report.html: what a run found, its figures and its case on one page."""

import csv
import os
import re
from html import escape
from pathlib import Path

from gradient import gradient_of, objective
from optimization_report import optimization_section
from page import cell, figure, folded, link, page, section, table
from read import read_result
from runs import harmonics_of, march_summaries

NAME = "report.html"
MOST_ROWS = 500
MOST_PARAMETERS = 40
POINT_COLUMNS = [
    ("reduced_velocity", "V"), ("reduced_velocity_error", "error of V"), ("speed_index", "V*"),
    ("frequency_ratio", "ω/ω_α"), ("frequency_error", "error of ω"), ("reduced_frequency", "k"),
    ("growth_rate", "σ/ω_α"), ("growth_rate_error", "error of σ"), ("energy", "E"), ("energy_error", "error of E"),
    ("average_energy", "E_avg"), ("pitch_amplitude_deg", "pitch, deg"), ("plunge_amplitude", "plunge h/b"),
    ("verdict", "verdict"), ("mode", "mode"), ("destabilising", "destabilising"),
    ("newton_iterations", "Newton"), ("linear_iterations", "Krylov"), ("staggered_iterations", "staggered"),
    ("flow_cycles", "flow cycles"), ("time_steps", "time steps"),
]
FLOW_COLUMNS = [("cl", "C_L"), ("cd", "C_D"), ("cm", "C_M"), ("residual", "residual"), ("iterations", "iterations"),
                ("linear_iterations", "Krylov")]
BRANCH_COLUMNS = [("asked", "asked"), ("energy", "E"), ("reduced_velocity", "V"), ("speed_index", "V*"),
                  ("frequency_ratio", "ω/ω_α"), ("harmonics", "N_H"), ("highest_harmonic_share", "share of N_H"),
                  ("pitch_amplitude_deg", "pitch, deg"), ("plunge_amplitude", "plunge h/b"), ("slope", "dV/dE"),
                  ("newton_iterations", "Newton"), ("linear_iterations", "Krylov"), ("status", "status")]
CHECK_COLUMNS = [("tangent", "adjoint - tangent"), ("finite_difference", "adjoint - difference"),
                 ("transpose", "transposes")]
PARAMETER_COLUMNS = [("derivative", "derivative"), ("difference", "finite difference")]
LEGEND = ("V = U/(c ω_α) reduced velocity, V* = U/(b ω_α √μ) speed index, k = ω b/U reduced frequency, E energy in "
          "units of m b² ω_α², times in 1/ω_α")


def entry_table(columns, entries, first=""):
    """One row an entry (name, dictionary); columns that no entry has are left out."""
    kept = [(key, head) for key, head in columns if any(entry.get(key) not in (None, "") for _, entry in entries)]
    rows = [[name, *(entry.get(key) for key, _ in kept)] for name, entry in entries]
    return table([first, *(head for _, head in kept)], rows) if rows and kept else ""


def points(result):
    """(name, entry) of every speed of a run: flutter, crossings, single marches; cycles have their own table."""
    found = []
    if result.get("linear_flutter"):
        found.append(("flutter, linearised", result["linear_flutter"]))
    crossings = (result.get("pk") or {}).get("crossings") or []
    found += [("crossing, p-k", entry) for entry in crossings]
    crossings = (result.get("g_method") or {}).get("crossings") or []
    found += [("crossing, g method", entry) for entry in crossings]
    if result.get("flutter"):
        marched = result.get("command") == "march"
        found.append(("flutter, marched in time" if marched else "flutter, time-spectral", result["flutter"]))
    found.append(("divergence", result.get("divergence")))
    return [(name, entry) for name, entry in found if isinstance(entry, dict)]


def complex_text(pair):
    return f"{pair[0]:.5g} {'-' if pair[1] < 0 else '+'} {abs(pair[1]):.5g} i" if isinstance(pair, list) else cell(pair)


def pitch_tables(result):
    pitch = result.get("pitch")
    if not isinstance(pitch, dict):
        return ""
    rows = [[entry.get("n"), *(complex_text(entry.get(load)) for load in ("cl", "cd", "cm"))]
            for entry in pitch.get("harmonics", [])]
    return table(["harmonic", "C_L", "C_D", "C_M"], rows) if rows else ""


def gradient_section(folder):
    """The objective, how far the checks of the derivatives were apart, and the first derivatives."""
    found = gradient_of(folder)
    name, _ = objective(folder)
    checks = found.get("check") if isinstance(found.get("check"), dict) else {}
    top = entry_table([("value", "value"), *CHECK_COLUMNS], [(name, {**checks, "value": found.get("value")})])
    entries = [(entry.get("name"), entry) for entry in found.get("design") or [] if isinstance(entry, dict)]
    rows = entry_table(PARAMETER_COLUMNS, entries[:MOST_PARAMETERS], "parameter")
    if len(entries) > MOST_PARAMETERS:
        rows += f"<p>The first {MOST_PARAMETERS} of {len(entries)} parameters; all are in gradient.csv.</p>"
    return section(f"Gradient of the {name}", "<p></p>".join(filter(None, (top, rows))))


def results_of(folder):
    """The tables of main results of a run."""
    result = read_result(folder)
    cycles = [entry for entry in result.get("lco") or [] if isinstance(entry, dict)]
    parts = [
        entry_table(POINT_COLUMNS, points(result)),
        entry_table(POINT_COLUMNS, [(f"march {n}", entry) for n, entry in enumerate(march_summaries(folder), 1)]),
        pitch_tables(result),
    ]
    if isinstance(result.get("steady"), dict):
        parts.append(entry_table(FLOW_COLUMNS, [("steady flow", result["steady"])]))
    content = "\n".join(f"<p></p>{part}" for part in parts if part)
    _, rows = read_rows(folder / "lco.csv")
    cycles = [{key: number(text) for key, text in row.items()} for row in rows] or cycles
    branch = [(entry.get("point", n), entry) for n, entry in enumerate(cycles, 1)]
    cycle_table = entry_table(BRANCH_COLUMNS, branch, "point")
    return "\n".join([section("Results", content), optimization_section(folder),
                      section("Points of the sweep", csv_table(folder / "sweep.csv")),
                      section("Branch of limit cycles", cycle_table),
                      gradient_section(folder)])


def read_rows(path):
    """Names of the columns and a dictionary of texts a row; nothing where there is no such file."""
    if not path.is_file():
        return [], []
    with open(path, newline="") as stream:
        reader = csv.DictReader(stream)
        return reader.fieldnames or [], list(reader)


def csv_table(path):
    """The rows of a table as they are; of a long one the last of each stage, or the first rows."""
    names, rows = read_rows(path)
    if not rows:
        return ""
    note = ""
    if len(rows) > MOST_ROWS:
        note = f"<p>{len(rows)} lines; "
        if "stage" in names:
            rows, note = list({row["stage"]: row for row in rows}.values()), note + "the last of each stage.</p>"
        else:
            note += f"the first {MOST_ROWS}.</p>"
        rows = rows[:MOST_ROWS]
    return note + table(names, [[number(row[name]) for name in names] for row in rows])


def number(text):
    try:
        return int(text) if re.fullmatch(r"[+-]?\d+", text or "") else float(text)
    except (TypeError, ValueError):
        return text


def case_text(folder):
    path = folder / "case.toml"
    return path.read_text(errors="replace") if path.is_file() else ""


def origin(folder):
    """Version, git commit, verb and case file, as the resolved case begins with them."""
    found = re.match(r"# (wingbeat \S+ \(([^)]*)\)): (\S+) (\S+)", case_text(folder))
    return {"program": found[1], "verb": found[3], "case": found[4]} if found else {}


def status_mark(result):
    status = result.get("status", "unknown")
    kind = "converged" if status == "converged" else "bad"
    return f'<span class="status {kind}">{escape(str(status))}</span>'


def seconds_of(result):
    seconds = result.get("wall_seconds")
    return seconds.get("total") if isinstance(seconds, dict) else seconds


def heading(folder):
    result, told = read_result(folder), origin(folder)
    verb = result.get("command") or told.get("verb") or "results"
    case = told.get("case", "")
    title = f"{verb}: {Path(case).parent.name if Path(case).name == 'case.toml' else Path(case).stem}" if case else verb
    title = title.rstrip(": ")
    facts = [told.get("program") or (f"wingbeat {result['version']}" if result.get("version") else "")]
    facts.append(case)
    if result.get("ranks"):
        facts.append(f"{result['ranks']} rank{'s' if result['ranks'] != 1 else ''}")
    if seconds_of(result) is not None:
        facts.append(f"{seconds_of(result):.1f} s")
    message = escape(str(result.get("message") or ""))
    return title, (f"<h1>{escape(title)}</h1>\n<p class=\"message\">{status_mark(result)} {message}</p>\n"
                   f'<p class="origin">{escape(" · ".join(fact for fact in facts if fact))}</p>')


def time_table(result):
    seconds = result.get("wall_seconds")
    if not isinstance(seconds, dict):
        return ""
    return folded("Wall-clock time", table(["part", "seconds"], list(seconds.items())))


def write(path, text):
    """Whole or not at all."""
    temporary = path.with_name(path.name + ".part")
    temporary.write_text(text, encoding="utf-8")
    os.replace(temporary, path)


def write_report(folder, figures):
    """The page of one run; `figures` are (path, caption)."""
    title, top = heading(folder)
    tail = [time_table(read_result(folder))]
    history = csv_table(folder / "history.csv")
    if history:
        tail.append(folded("Iterations (history.csv)", history))
    if case_text(folder):
        tail.append(folded("Resolved case (case.toml)", f"<pre>{escape(case_text(folder))}</pre>"))
    shown = "\n".join(figure(path, caption) for path, caption in figures)
    write(folder / NAME, page(title, [top, results_of(folder), f'<p class="origin">{escape(LEGEND)}.</p>',
                                      section("Figures", shown), section("Details", "\n".join(filter(None, tail)))]))


def summary_row(run):
    result = read_result(run)
    speeds = [result.get("linear_flutter"), result.get("flutter")]
    cycles = [entry for entry in result.get("lco") or [] if isinstance(entry, dict)] + march_summaries(run)
    last = cycles[-1] if cycles else {}
    speeds = [(entry or {}).get("reduced_velocity") for entry in speeds]
    name = link(f"{run.name}/{NAME}", run.name) if (run / NAME).is_file() else run.name
    return [name, result.get("command"), result.get("status"), harmonics_of(run), *speeds,
            last.get("reduced_velocity"), last.get("frequency_ratio"), last.get("energy"), result.get("ranks"),
            seconds_of(result)]


def write_comparison_report(folder, runs, figures):
    """The page of a folder of runs: one row a run, and the figures that compare them."""
    header = ["run", "verb", "status", "N_H", "V_F linearised", "V_F", "last cycle or march: V", "ω/ω_α", "E", "ranks",
              "seconds"]
    rows = [summary_row(run) for run in runs]
    kept = [i for i in range(len(header)) if any(row[i] not in (None, "") for row in rows)]
    summary = table([header[i] for i in kept], [[row[i] for i in kept] for row in rows])
    title = f"{folder.resolve().name}: {len(runs)} runs"
    shown = "\n".join(figure(path, caption) for path, caption in figures)
    write(folder / NAME, page(title, [f"<h1>{escape(title)}</h1>", section("Runs", summary),
                                      f'<p class="origin">{escape(LEGEND)}.</p>', section("Figures", shown)]))
