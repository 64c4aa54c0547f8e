#!/usr/bin/env python3
"""Draws what a run left in its folder into DIR/plots, and writes DIR/report.html.

    plot.py DIR

Each figure is drawn if its file is there:
    lco.csv                 energy, reduced_velocity, frequency_ratio             branch of limit cycles
    cycles.csv              point, instance, phase, plunge, pitch_deg, rates      phase portraits
    march.csv               time, reduced_velocity, energy, motion, loads         energy and motion in time
    pk.csv, g_method.csv    reduced_velocity, mode, frequency, damping, status    p-k curves
    aerodynamic_matrix.csv  k, Qhh_re, Qhh_im, ..., Qaa_im                        size and phase of Q(k)
    loads.csv               phase, pitch_deg, plunge, cl, cm                      loops of a prescribed motion
    surface.csv             instance, phase, block, x, y, x_body, y_body, cp      pressure on the section
    solution.cgns           nodes, Pressure and Mach of every instance            pressure around the section
    history.csv             stage, iteration, flow, structure, phase, energy      convergence
    bumps.csv, wall.csv     bump, s, x, y                                         crests of the bumps, one of them
    gradient.csv            name, derivative, difference                          gradient, parameter by parameter
    wall.csv                s, x, y, normal_x, ..., derivative_normal             sensitivity along the wall
    step_study.csv          step, difference, relative_error                      differences against the adjoint
    optimization.csv        iteration, objective, outputs, errors, design          course of an optimisation
    evaluations.jsonl       a line a design: outputs, flutter roots                roots over the iterations
    baseline/, optimum/     airfoil.dat, runs of steady, lco, pk                   both sections on one figure
    sweep.csv               parameters, speeds or loads, branch, status           a sweep, curve or contours
    mesh.csv                zone, i, j, x, y                                      mesh near the section
pitch_rate is in radians; rates and times are in units of omega_alpha.
result.json and case.toml add flutter points, Mach number and mass ratio.
If DIR has sub-folders with runs, each is drawn, and what they have in common is compared in DIR/plots.
Exits with status 1 and a message where nothing can be drawn.
"""

import sys
from pathlib import Path

sys.dont_write_bytecode = True  # the folder of the program may not be the user's to write

try:
    import aerodynamic_matrix
    import branch
    import contours
    import convergence
    import gradient_bars
    import gradient_bumps
    import gradient_steps
    import loops
    import march
    import mesh
    import optimization_branches
    import optimization_cost
    import optimization_history
    import optimization_matrix
    import optimization_pk
    import optimization_pressure
    import optimization_roots
    import optimization_section
    import phase_portrait
    import pk
    import pressure
    import pressure_compare
    import response
    import speed_convergence
    import surface_sensitivity
    import sweep_contour
    import sweep_curve
    from read import BadTable, Skipped
    from report import write_comparison_report, write_report
    from runs import runs_in
    from style import plt
except ModuleNotFoundError as missing:
    sys.exit(f"plot: Python at {sys.executable} has no {missing.name}; "
             "install it with: apt-get install python3-matplotlib")

OPTIMIZATION = [optimization_history, optimization_section, optimization_pressure, optimization_branches,
                optimization_matrix, optimization_pk, optimization_roots, optimization_cost]
FIGURES = [*OPTIMIZATION, sweep_curve, sweep_contour, branch, phase_portrait, march, response, pk, aerodynamic_matrix,
           loops, pressure, contours, gradient_bars, gradient_bumps, surface_sensitivity, gradient_steps,
           speed_convergence, convergence, mesh]
COMPARISONS = [branch, phase_portrait, march, pressure_compare, pk, aerodynamic_matrix]


class Drawing:
    """Figures as they are drawn: (path, caption) of each, and what was wrong or left out."""

    def __init__(self):
        self.figures, self.faults, self.skipped = [], [], []

    def add(self, draw, subject, target, caption):
        """Draws one figure; one that has no data leaves nothing."""
        try:
            figure = draw(subject)
        except BadTable as fault:
            if str(fault) not in self.faults:
                self.faults.append(str(fault))
            return
        except Skipped as reason:
            self.skipped.append(f"{target}: skipped, {reason}")
            return
        if figure is None:
            return
        target.parent.mkdir(exist_ok=True)
        figure.savefig(target)
        plt.close(figure)
        self.figures.append((target, caption))

    def take(self, other):
        self.figures += other.figures
        self.faults += other.faults
        self.skipped += other.skipped


def draw_run(folder):
    drawing = Drawing()
    for module in FIGURES:
        drawing.add(module.draw, folder, folder / "plots" / f"{module.NAME}.png", module.CAPTION)
    return drawing


def draw_comparisons(folder, runs):
    drawing = Drawing()
    for module in COMPARISONS:
        drawing.add(module.compare, runs, folder / "plots" / f"{module.NAME}-compared.png", module.COMPARED)
    return drawing


def draw_all(folder):
    """Figures and reports of a folder and of the runs in it."""
    own, runs = draw_run(folder), runs_in(folder)
    whole = Drawing()
    whole.take(own)
    for run in runs:
        of_run = draw_run(run)
        whole.take(of_run)
        if of_run.figures:
            write_report(run, of_run.figures)
    if runs:
        compared = draw_comparisons(folder, runs)
        compared.faults = [fault for fault in compared.faults if fault not in whole.faults]
        whole.take(compared)
        if whole.figures:
            write_comparison_report(folder, runs, compared.figures + own.figures)
    elif own.figures:
        write_report(folder, own.figures)
    return whole


def main(arguments):
    if len(arguments) != 1:
        sys.exit(__doc__)
    folder = Path(arguments[0])
    if not folder.is_dir():
        sys.exit(f"plot: {folder}: no such folder")
    drawing = draw_all(folder)
    for path, _ in drawing.figures:
        print(path)
    if drawing.figures:
        print(folder / "report.html")
    for message in drawing.skipped + drawing.faults:
        print(f"plot: {message}", file=sys.stderr)
    if not drawing.figures and not drawing.faults:
        sources = ", ".join(dict.fromkeys(module.SOURCE for module in FIGURES))
        sys.exit(f"plot: {folder}: nothing to draw; none of {sources} is there or holds rows")
    return 1 if drawing.faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
