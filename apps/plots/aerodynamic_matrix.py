"""The aerodynamic matrix Q(k): size and phase of every load per degree of freedom."""

import numpy as np

from read import BadTable, read_result, read_table
from style import COLOURS, FURTHER, LINES, mark_speed, plt

NAME = "aerodynamic_matrix"
SOURCE = "aerodynamic_matrix.csv"
FORCED = "aerodynamic_matrix_forced.csv"
CAPTION = ("Size and phase of the aerodynamic matrix against reduced frequency. Lines: linearised flow; squares, "
           "where they were run: time-spectral flow about a forced motion.")
COMPARED = ("Size and phase of the entries of the aerodynamic matrix; one style of line a section, squares: forced "
            "motion.")
ENTRIES = [
    ("hh", r"$-C_l$ by $h/b$", "lift", (0, (5, 2))),
    ("ha", r"$-C_l$ by $\alpha$", "lift", "-"),
    ("ah", r"$2C_m$ by $h/b$", "moment", (0, (5, 2))),
    ("aa", r"$2C_m$ by $\alpha$", "moment", "-"),
]
SECTION = r", $(-C_l,\ 2C_m) = Q(k)\,(h/b,\ \alpha)$"
MOST_ENTRIES = 16


def read_matrix(path, like=None):
    """The table, which must have the columns of `like` if that is given; None if there is no such file."""
    table = read_table(path, ["k"])
    if table is None:
        return None
    if like is not None:
        needed = [name for name in like if name.startswith("Q")]
    else:
        names = [entry for entry, *_ in entries_of(table)] or ["hh"]
        needed = [f"Q{name}_{part}" for name in names for part in ("re", "im")]
    missing = [name for name in needed if name not in table]
    if missing:
        raise BadTable(f"{path}: no column {', '.join(missing)}; it has {', '.join(table)}")
    return table


def is_section(table):
    return any(f"Q{entry}_re" in table for entry, *_ in ENTRIES)


def entries_of(table):
    """(name in the columns, label, colour, line) of the entries to be drawn; of a large matrix its diagonal."""
    if is_section(table):
        return [(entry, label, COLOURS[load], dashes) for entry, label, load, dashes in ENTRIES]
    names = [name[1:-3] for name in table if name.startswith("Q") and name.endswith("_re")]
    size = max(round(len(names) ** 0.5), 1)
    places = [(i, j) for i in range(size) for j in range(size) if i == j or len(names) <= MOST_ENTRIES]
    return [(names[i * size + j], rf"$Q_{{{i + 1},{j + 1}}}$", FURTHER[i % len(FURTHER)], LINES[j % len(LINES)])
            for i, j in places if i * size + j < len(names)]


def sizes_and_phases(table, entry):
    """k, |Q| and the phase in degrees without jumps, in order of k."""
    order = np.argsort(table["k"], kind="stable")
    q = (table[f"Q{entry}_re"] + 1j * table[f"Q{entry}_im"])[order]
    phase = np.full(len(q), np.nan)
    seen = np.abs(q) > 1e-9 * np.max(np.abs(q))  # what vanishes, as at k = 0, has no phase
    phase[seen] = np.degrees(np.unwrap(np.angle(q[seen])))
    return table["k"][order], np.abs(q), phase


def beside(k, phase, of_k, of_phase):
    """The phase, by whole turns, nearest to that of another table."""
    known = np.isfinite(of_phase)
    if not known.any() or np.all(np.isnan(phase)):
        return phase
    return phase + 360.0 * np.round(np.nanmean(np.interp(k, of_k[known], of_phase[known]) - phase) / 360.0)


def draw(folder):
    table = read_matrix(folder / SOURCE)
    if table is None:
        return None
    forced = read_matrix(folder / FORCED, table)
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(8, 7.5), sharex=True, layout="constrained")
    for entry, label, colour, dashes in entries_of(table):
        k, size, phase = sizes_and_phases(table, entry)
        style = {"color": colour, "linestyle": dashes, "marker": "o", "markersize": 3}
        upper.plot(k, size, label=label, **style)
        lower.plot(k, phase, **style)
        if forced is None:
            continue
        at, forced_size, forced_phase = sizes_and_phases(forced, entry)
        upper.plot(at, forced_size, "s", color=colour, markersize=7, markerfacecolor="none")
        lower.plot(at, beside(at, forced_phase, k, phase), "s", color=colour, markersize=7, markerfacecolor="none")
    if forced is not None:
        upper.plot([], [], "s", color=COLOURS["line"], markersize=7, markerfacecolor="none", label="forced motion")
    flutter = read_result(folder).get("linear_flutter") or {}
    if flutter.get("reduced_frequency") is not None:
        for axes in (upper, lower):
            mark_speed(axes, flutter["reduced_frequency"])
        upper.annotate("flutter", (flutter["reduced_frequency"], 1.0), xycoords=("data", "axes fraction"),
                       xytext=(4, -10), textcoords="offset points", fontsize=8, color=COLOURS["flutter"])
    upper.set(ylabel=r"$|Q|$, per radian and per semichord" if is_section(table) else r"$|Q|$", ylim=(0.0, None),
              title="Aerodynamic matrix" + (SECTION if is_section(table) else ""))
    lower.set(ylabel="phase, deg", xlabel=r"reduced frequency $k = \omega b/U$", xlim=(0.0, None))
    lower.yaxis.set_major_locator(plt.MultipleLocator(45.0))
    upper.legend(ncols=2, handlelength=4)
    return figure


def compare(folders):
    return overlay([(folder.name, folder) for folder in folders])


def overlay(runs):
    """The matrices of several runs, (name, folder) each; None if fewer than two have one of a section."""
    found = [(name, folder, read_matrix(folder / SOURCE)) for name, folder in runs]
    found = [(name, table, read_matrix(folder / FORCED, table)) for name, folder, table in found
             if table is not None and is_section(table)]
    if len(found) < 2:
        return None
    figure, panels = plt.subplots(2, len(ENTRIES), figsize=(13, 6.2), sharex=True, layout="constrained")
    for (upper, lower), (entry, label, load, _) in zip(panels.T, ENTRIES):
        first = None
        for number, (name, table, forced) in enumerate(found):
            k, size, phase = sizes_and_phases(table, entry)
            first = first or (k, phase)
            style = {"color": COLOURS[load], "linestyle": LINES[number % len(LINES)]}
            upper.plot(k, size, label=name, **style)
            lower.plot(k, beside(k, phase, *first), **style)
            if forced is not None:
                at, forced_size, forced_phase = sizes_and_phases(forced, entry)
                upper.plot(at, forced_size, "s", color=COLOURS[load], markersize=5, markerfacecolor="none")
                lower.plot(at, beside(at, forced_phase, *first), "s", color=COLOURS[load], markersize=5,
                           markerfacecolor="none")
        upper.set(title=label, ylim=(0.0, None))
        lower.set(xlabel=r"$k = \omega b/U$", xlim=(0.0, None))
        lower.yaxis.set_major_locator(plt.MaxNLocator(7, steps=[1, 2, 3, 5, 10], integer=True))
    panels[0, 0].set_ylabel(r"$|Q|$, per radian and per semichord")
    panels[1, 0].set_ylabel("phase, deg")
    panels[0, 0].legend(loc="best", handlelength=3)
    figure.suptitle("Aerodynamic matrix" + SECTION, fontsize=11)
    return figure
