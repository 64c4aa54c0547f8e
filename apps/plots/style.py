"""How the figures look: one colour for one thing, wherever it appears."""

import colorsys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

COLOURS = {
    # rows of the coupled problem
    "flow": "#1f5fa8",
    "structure": "#c8501e",
    "phase": "#2f8f57",
    "energy": "#8a4fa3",
    # degrees of freedom and what loads them
    "plunge": "#1f5fa8",
    "pitch": "#c8501e",
    "lift": "#1f5fa8",
    "moment": "#c8501e",
    # methods, where both are on one figure
    "time-spectral": "#1f5fa8",
    "march": "#1c1c1c",
    "adjoint": "#1f5fa8",
    "difference": "#c8501e",
    # an optimisation
    "baseline": "#4f5b66",
    "optimum": "#1f5fa8",
    "bound": "#b3152b",
    # surfaces of the section, where both curves may be one
    "upper": "#1f5fa8",
    "lower": "#c8501e",
    # marks
    "flutter": "#b3152b",
    "sonic": "#606060",
    "line": "#808080",
    "mesh": "#3a4653",
    "linear": "#a9b4bf",
}
LINES = ["-", (0, (5, 2)), (0, (1, 1.3)), (0, (5, 1.5, 1, 1.5))]  # runs beside each other
# Modes beyond the two of a section, branches of any number.
FURTHER = ["#2f8f57", "#8a4fa3", "#a08018", "#3a98a8", "#7a4a2a", "#606060"]

plt.rcParams.update({
    "figure.dpi": 100,
    "savefig.dpi": 160,
    "font.size": 10,
    "axes.titlesize": 11,
    "axes.labelsize": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e6e9ec",
    "grid.linewidth": 0.7,
    "axes.axisbelow": True,
    "lines.linewidth": 1.4,
    "legend.frameon": False,
    "legend.fontsize": 9,
    "mathtext.fontset": "dejavusans",
})


def harmonic_colour(harmonics):
    """Colour of the cycles with N_H harmonics: the more, the darker."""
    return matplotlib.colormaps["viridis"](np.interp(harmonics, [1.0, 6.0], [0.86, 0.08]))


def speed_colours(count):
    """Colours of rising speeds."""
    return [matplotlib.colormaps["plasma"](share) for share in np.linspace(0.02, 0.82, max(count, 2))][:count]


def energy_colours(count):
    """Colours of rising energies: the larger, the darker."""
    return [matplotlib.colormaps["PuRd"](share) for share in np.linspace(0.42, 1.0, max(count, 2))][:count]


def mode_colour(name, number):
    """Colour of a mode of vibration: its own, or the next of the further ones."""
    return COLOURS[name] if name in COLOURS else FURTHER[number % len(FURTHER)]


def phase_colour(phase_in_turns):
    """Colour of an instant of the period; it returns after a turn."""
    return colorsys.hls_to_rgb((0.6 + phase_in_turns) % 1.0, 0.42, 0.72)


def mark_zero(axes):
    axes.axhline(0.0, color=COLOURS["line"], linewidth=0.8, zorder=1)


def mark_speed(axes, value, name="flutter"):
    axes.axvline(value, color=COLOURS[name], linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)


def panel_grid(count, most_columns, size, right=0.15):
    """A figure with `count` panels of one size, in rows with few places left over: (figure, panels, grid).

    Sizes in inches, `right`: what is left free there. The lowest panel of each column has the labels of the abscissa.
    """
    left, bottom, top, across, down = 0.75, 0.55, 0.65, 0.25, 0.45
    columns = min(count, min(range(max(most_columns - 1, 1), most_columns + 1), key=lambda n: (-count % n, -n)))
    rows = -(-count // columns)
    if count % columns:
        down = 0.75  # labels between the rows
    width = left + columns * size[0] + (columns - 1) * across + right
    height = bottom + rows * size[1] + (rows - 1) * down + top
    places = {"left": left / width, "right": 1.0 - right / width, "bottom": bottom / height,
              "top": 1.0 - top / height, "wspace": across / size[0], "hspace": down / size[1]}
    figure, grid = plt.subplots(rows, columns, squeeze=False, sharex=True, sharey=True, figsize=(width, height),
                                gridspec_kw=places)
    for number, axes in enumerate(grid.flat):
        if number >= count:
            axes.axis("off")
        elif number + columns >= count:
            axes.tick_params(labelbottom=True)
    return figure, list(grid.flat[:count]), grid
