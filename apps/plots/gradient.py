"""What `wingbeat gradient` found: its objective, its parameters, the crests of the bumps and the wall."""

import re

import numpy as np

from read import read_result, read_table

SOURCE = "gradient.csv"
ROOM = 0.06  # around a section, chords
OBJECTIVES = {
    "drag": ("drag", "C_D"),
    "lift": ("lift", "C_L"),
    "moment": ("moment", "C_m"),
    "flutter_speed": ("flutter speed", "V_F"),
    "flutter_frequency": ("flutter frequency", r"(\omega_F/\omega_\alpha)"),
    "lco_speed": ("speed of the cycle", "V"),
    "lco_frequency": ("frequency of the cycle", r"(\omega/\omega_\alpha)"),
    "lco_amplitude": ("pitch amplitude of the cycle", r"|\alpha_1|"),
    "lco_energy": ("energy of the cycle", "E"),
    "onset_slope": ("slope of the branch at its onset", "(dV/dE)"),
}
PARAMETERS = {
    "mach": ("Mach number", r"M_\infty"),
    "angle_of_attack_deg": ("angle of attack, deg", r"\alpha_0"),
    "elastic_axis": ("elastic axis", "a"),
    "static_unbalance": ("static unbalance", r"x_\alpha"),
    "gyration_radius_squared": ("gyration radius squared", r"r_\alpha^2"),
    "frequency_ratio": ("frequency ratio", r"(\omega_h/\omega_\alpha)"),
    "mass_ratio": ("mass ratio", r"\mu"),
}


def gradient_of(folder):
    """What result.json says of the gradient, or nothing."""
    gradient = read_result(folder).get("gradient")
    return gradient if isinstance(gradient, dict) else {}


def objective(folder):
    """(name, symbol) of the objective."""
    name = gradient_of(folder).get("objective")
    return OBJECTIVES.get(name, (str(name or "objective").replace("_", " "), "J"))


def title_of(folder, subject):
    """`subject` of the objective, with its value where it is known."""
    name, symbol = objective(folder)
    value = gradient_of(folder).get("value")
    return f"{subject} of the {name}, ${symbol.strip('()')}$" + (f" = {value:.5g}" if isinstance(value, (int, float)) else "")


def read_parameters(folder):
    """(bumps, others): numbers or names, "derivative" and "difference" of each; None if there is no table."""
    table = read_table(folder / SOURCE, ["name", "derivative", "difference"])
    if table is None:
        return None
    names = [str(name) for name in table["name"]]
    numbers = [re.fullmatch(r"bump (\d+)", name) for name in names]
    bumps = np.array([number is not None for number in numbers])
    parts = [{key: table[key][rows] for key in ("derivative", "difference")} for rows in (bumps, ~bumps)]
    parts[0]["number"] = np.array([int(number[1]) for number in numbers if number])
    parts[1]["name"] = [name for name, number in zip(names, numbers) if not number]
    return parts


def read_whole(path, columns, needed):
    """The rows of a table of numbers that hold all of `needed`, a part of `columns`: the last may be cut off."""
    table = read_table(path, columns)
    if table is None:
        return None
    whole = np.isfinite([table[name] for name in needed]).all(axis=0)
    if not whole.any():
        return None
    return {name: values[whole] for name, values in table.items() if not isinstance(values, list)}


def read_crests(folder):
    """Numbers, arc parameters and places of the bumps' crests, or None."""
    columns = ["bump", "s", "x", "y"]
    return read_whole(folder / "bumps.csv", columns, columns)


def read_wall(folder, columns):
    """The wall with these columns besides its places and normals, from the trailing edge and back to it; or None."""
    shape = ["s", "x", "y", "normal_x", "normal_y"]
    table = read_whole(folder / "wall.csv", [*shape, *columns], shape)
    if table is None or len(table["s"]) < 3:
        return None
    wall = {name: np.append(values, values[0]) for name, values in table.items()}
    wall["s"][-1] = 1.0  # the trailing edge again, of the upper surface
    return wall


def along_normal(wall, distance):
    """Places of the wall's nodes moved outward."""
    return wall["x"] + distance * wall["normal_x"], wall["y"] + distance * wall["normal_y"]


def frame_section(axes, x, y):
    """Shows an outline at its true shape, with room around it."""
    axes.set(aspect="equal", ylabel="y / c", xlim=(x.min() - ROOM, x.max() + ROOM),
             ylim=(y.min() - ROOM, y.max() + ROOM))
    axes.grid(False)


def inches_of(x, y, width):
    """Height of such a frame that is `width` inches wide."""
    return width * (np.ptp(y) + 2.0 * ROOM) / (np.ptp(x) + 2.0 * ROOM)
