"""Pressure around the section at every instance, on the moved mesh, with the sonic line."""

import numpy as np

from read import BadTable, Skipped, case_value, read_case, read_result
from style import panel_grid

NAME = "contours"
SOURCE = "solution.cgns"
CAPTION = "Pressure coefficient around the section at the instances of the period. Black line: sonic."
COLUMNS = 4
WINDOW = ((-0.45, 1.45), (-0.75, 0.75))
MOST_SHOWN = 15


def open_file(path):
    try:
        import h5py
    except ModuleNotFoundError:
        raise Skipped("no h5py; install it with: apt-get install python3-h5py") from None
    try:
        return h5py.File(path, "r")
    except OSError as fault:
        raise BadTable(f"{path}: {fault}") from None


def label_of(node):
    return node.attrs.get("label", b"").decode()


def children(node, label):
    return {name: child for name, child in node.items() if hasattr(child, "keys") and label_of(child) == label}


def array(node, name, path):
    if name not in node or " data" not in node[name]:
        raise BadTable(f"{path}: {node.name} has no {name}")
    return node[name][" data"][()]


def read_zones(path):
    """[instance][zone] -> (x, y of nodes, p and Mach number of cells), and the instances' phases or None."""
    with open_file(path) as file:
        base = next(iter(children(file, "CGNSBase_t").values()), None)
        if base is None:
            raise BadTable(f"{path}: no CGNSBase_t")
        zones = list(children(base, "Zone_t").values())
        count = min((len(children(zone, "FlowSolution_t")) for zone in zones), default=0)
        instances = []
        for number in range(1, count + 1):
            parts = []
            for zone in zones:
                grid = zone.get(f"GridCoordinates{number}", zone.get("GridCoordinates"))
                flow = zone.get(f"FlowSolution{number}")
                if grid is None or flow is None:
                    raise BadTable(f"{path}: {zone.name} has no nodes or no flow of instance {number}")
                parts.append(tuple(array(group, name, path) for group, name in (
                    (grid, "CoordinateX"), (grid, "CoordinateY"), (flow, "Pressure"), (flow, "Mach"))))
            instances.append(parts)
        try:
            times = base["BaseIterativeData/TimeValues/ data"][()]
            omega = base["RestartData/omega/ data"][0]
            phases = times * omega if omega > 0.0 and len(times) == count else None
        except KeyError:
            phases = None
    return instances, phases


def at_nodes(zones, field):
    """Values of cells averaged at the nodes, across the zones that share one."""
    x = np.concatenate([zone[0].ravel() for zone in zones])
    y = np.concatenate([zone[1].ravel() for zone in zones])
    _, node = np.unique(np.round(np.column_stack([x, y]), 9), axis=0, return_inverse=True)
    sums, shares = [], []
    for zone in zones:
        values = zone[field]
        total, share = np.zeros(zone[0].shape), np.zeros(zone[0].shape)
        for corner in ((slice(None, -1), slice(None, -1)), (slice(None, -1), slice(1, None)),
                       (slice(1, None), slice(None, -1)), (slice(1, None), slice(1, None))):
            total[corner] += values
            share[corner] += 1.0
        sums.append(total.ravel())
        shares.append(share.ravel())
    mean = np.bincount(node.ravel(), np.concatenate(sums)) / np.bincount(node.ravel(), np.concatenate(shares))
    mean = mean[node.ravel()]
    ends = np.cumsum([zone[0].size for zone in zones])[:-1]
    return [part.reshape(zone[0].shape) for part, zone in zip(np.split(mean, ends), zones)]


def in_window(zone):
    """The part of a zone's nodes that has to do with the window, as slices."""
    x, y, *_ = zone
    inside = (np.abs(x - np.mean(WINDOW[0])) < 1.5) & (np.abs(y) < 1.2)
    if not inside.any():
        return None
    return tuple(slice(max(found.min() - 1, 0), found.max() + 2) for found in np.nonzero(inside))


def draw_instance(axes, zones, coefficients, machs, levels):
    filled = None
    for zone, cp, mach in zip(zones, coefficients, machs):
        part = in_window(zone)
        if part is None or min(cp[part].shape) < 2:
            continue
        x, y = zone[0][part], zone[1][part]
        filled = axes.contourf(x, y, cp[part], levels, cmap="RdBu_r", extend="both")
        axes.contour(x, y, cp[part], levels[::2], linestyles="solid", colors="#30303050", linewidths=0.3)
        if mach[part].min() < 1.0 < mach[part].max():
            axes.contour(x, y, mach[part], [1.0], colors="black", linewidths=1.1)
    axes.set(xlim=WINDOW[0], ylim=WINDOW[1], aspect="equal")
    axes.grid(False)
    return filled


def shown(folder, instances, phases):
    """(title, zones) of what is drawn: of a march, whose file holds successive time levels, the first."""
    if read_result(folder).get("command") == "march":
        return [("at the end of the march", instances[0])]
    if len(instances) == 1:
        return [("", instances[0])]
    chosen = np.unique(np.linspace(0, len(instances) - 1, MOST_SHOWN).round().astype(int))
    return [(rf"$\theta$ = {np.degrees(phases[i]):.0f}°" if phases is not None else f"instance {i}", instances[i])
            for i in chosen]


def draw(folder):
    path = folder / SOURCE
    mach = case_value(read_case(folder), "flow", "mach")
    if not path.is_file() or not mach:
        return None
    instances, phases = read_zones(path)
    if not instances or instances[0][0][0].ndim != 2:
        return None
    gamma = case_value(read_case(folder), "flow", "gamma", 1.4)
    panels = shown(folder, instances, phases)
    nodes = [([(p - 1.0) / (0.5 * gamma * mach**2) for p in at_nodes(zones, 2)], at_nodes(zones, 3))
             for _, zones in panels]
    extent = max(np.percentile(np.abs(np.concatenate([cp.ravel() for cp in cps])), 99.5) for cps, _ in nodes)
    step = 0.05 if extent < 1.0 else 0.1
    most = step * np.ceil(extent / step)
    levels = np.linspace(-most, most, 2 * round(most / step) + 1)
    width = 2.9 if len(panels) > 1 else 7.0
    size = (width, width * np.ptp(WINDOW[1]) / np.ptp(WINDOW[0]))
    figure, shown_axes, grid = panel_grid(len(panels), COLUMNS, size, right=1.0)
    for axes, (title, zones), (cp, machs) in zip(shown_axes, panels, nodes):
        filled = draw_instance(axes, zones, cp, machs, levels)
        axes.set_title(title, fontsize=10)
    for axes in shown_axes[-grid.shape[1]:]:
        axes.set_xlabel("x / c")
    for axes in grid[:, 0]:
        axes.set_ylabel("y / c")
    inches, low, high = figure.get_figwidth(), grid[-1, 0].get_position().y0, grid[0, 0].get_position().y1
    beside = figure.add_axes([1.0 - 0.85 / inches, low, 0.16 / inches, high - low])
    bar = figure.colorbar(filled, cax=beside)
    bar.set_ticks([level for level in levels if abs(level / (4.0 * step) - round(level / (4.0 * step))) < 1e-6])
    bar.set_label(r"pressure coefficient $C_p$")
    figure.suptitle(f"Pressure around the section, Mach {mach:g}", fontsize=11)
    return figure
