"""How the figures look: one colour for one thing, wherever it appears."""

import colorsys

import matplotlib

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
    # marks
    "flutter": "#b3152b",
    "sonic": "#606060",
    "line": "#808080",
    "mesh": "#3a4653",
    "linear": "#a9b4bf",
}
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
