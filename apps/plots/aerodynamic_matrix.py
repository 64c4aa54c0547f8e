"""The aerodynamic matrix Q(k): size and phase of every load per degree of freedom."""

import numpy as np

from read import read_result, read_table
from style import COLOURS, mark_speed, plt

NAME = "aerodynamic_matrix"
SOURCE = "aerodynamic_matrix.csv"
ENTRIES = [
    ("hh", r"$-C_l$ by $h/b$", "lift", (0, (5, 2))),
    ("ha", r"$-C_l$ by $\alpha$", "lift", "-"),
    ("ah", r"$2C_m$ by $h/b$", "moment", (0, (5, 2))),
    ("aa", r"$2C_m$ by $\alpha$", "moment", "-"),
]


def draw(folder):
    columns = ["k"] + [f"Q{entry}_{part}" for entry, *_ in ENTRIES for part in ("re", "im")]
    table = read_table(folder / SOURCE, columns)
    if table is None:
        return None
    k = table["k"]
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(8, 7.5), sharex=True, layout="constrained")
    for entry, label, load, dashes in ENTRIES:
        q = table[f"Q{entry}_re"] + 1j * table[f"Q{entry}_im"]
        style = {"color": COLOURS[load], "linestyle": dashes, "marker": "o", "markersize": 3}
        upper.plot(k, np.abs(q), label=label, **style)
        lower.plot(k, np.degrees(np.unwrap(np.angle(q))), **style)
    flutter = read_result(folder).get("linear_flutter") or {}
    if flutter.get("reduced_frequency") is not None:
        for axes in (upper, lower):
            mark_speed(axes, flutter["reduced_frequency"])
        upper.annotate("flutter", (flutter["reduced_frequency"], 1.0), xycoords=("data", "axes fraction"),
                       xytext=(4, -10), textcoords="offset points", fontsize=8, color=COLOURS["flutter"])
    upper.set(ylabel=r"$|Q|$, per radian and per semichord", ylim=(0.0, None),
              title=r"Aerodynamic matrix, $(-C_l,\ 2C_m) = Q(k)\,(h/b,\ \alpha)$")
    lower.set(ylabel="phase, deg", xlabel=r"reduced frequency $k = \omega b/U$", xlim=(0.0, None))
    lower.yaxis.set_major_locator(plt.MultipleLocator(45.0))
    upper.legend(ncols=2, handlelength=4)
    return figure
