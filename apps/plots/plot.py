#!/usr/bin/env python3
"""Draws what a run left in its folder into DIR/plots.

    plot.py DIR

Each figure is drawn if its table is there:
    mesh.csv                zone, i, j, x, y                                      mesh near the section
    surface.csv             instance, phase, block, x, y, x_body, y_body, cp      pressure on the section
    loads.csv               phase, pitch_deg, plunge, cl, cm                      loops of a prescribed motion
    pk.csv                  reduced_velocity, mode, frequency, damping, status    p-k curves
    aerodynamic_matrix.csv  k, Qhh_re, Qhh_im, ..., Qaa_im                        size and phase of Q(k)
    history.csv             stage, iteration, flow, structure, phase, energy      convergence
result.json and case.toml add flutter points, Mach number and mass ratio.
Exits with status 1 and a message where nothing can be drawn.
"""

import sys
from pathlib import Path

sys.dont_write_bytecode = True  # the folder of the program may not be the user's to write

try:
    import aerodynamic_matrix
    import convergence
    import loops
    import mesh
    import pk
    import pressure
    from read import BadTable
    from style import plt
except ModuleNotFoundError as missing:
    sys.exit(f"plot: Python at {sys.executable} has no {missing.name}; "
             "install it with: apt-get install python3-matplotlib")

FIGURES = [mesh, pressure, loops, pk, aerodynamic_matrix, convergence]


def draw_all(folder):
    """Paths of the figures drawn, and faults of the tables that were there but bad."""
    drawn, faults = [], []
    for module in FIGURES:
        try:
            figure = module.draw(folder)
        except BadTable as fault:
            faults.append(str(fault))
            continue
        if figure is None:
            continue
        target = folder / "plots" / f"{module.NAME}.png"
        target.parent.mkdir(exist_ok=True)
        figure.savefig(target)
        plt.close(figure)
        drawn.append(target)
    return drawn, faults


def main(arguments):
    if len(arguments) != 1:
        sys.exit(__doc__)
    folder = Path(arguments[0])
    if not folder.is_dir():
        sys.exit(f"plot: {folder}: no such folder")
    drawn, faults = draw_all(folder)
    for path in drawn:
        print(path)
    for fault in faults:
        print(f"plot: {fault}", file=sys.stderr)
    if not drawn and not faults:
        sources = ", ".join(module.SOURCE for module in FIGURES)
        sys.exit(f"plot: {folder}: nothing to draw; none of {sources} is there or holds rows")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
