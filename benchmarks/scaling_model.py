#!/usr/bin/env python3
"""Predicts the time of a Runge-Kutta multigrid cycle on many ranks.

    scaling_model.py WINGBEAT [--cells AROUND NORMAL] [--harmonics N] [--ranks P ...] [--cycle w|v]
                                [--figure FILE]

Halos and imbalance of the finest mesh are those of `WINGBEAT partition`; blocks are taken as equal
and as square as their cells allow. The rest is counted from the algorithm, and the rates below are
measured (kernels benchmark) or assumed (network). Two bounds are printed: messages of one exchange
under way at once, and one after another. Neither hides messages behind computation, as the program
does not.
"""
import argparse
import json
import math
import pathlib
import subprocess
import tempfile

# Measured: nanoseconds of a Runge-Kutta stage of one instance on one core, through 16x4, 16x16 and
# 64x64 cells with seven instances.
NS_A_CELL, NS_A_FACE_OF_THE_BLOCK, NS_A_STAGE = 38.7, 8.7, 1547.0
# Assumed network: seconds a message, bytes a second and rank.
LATENCY, BANDWIDTH = 1.5e-6, 10e9

STAGES, DIRECTIONS, LAYERS, VARIABLES, BYTES = 5, 2, 2, 4, 8
REDUCTIONS = 3  # a cycle: residual, physical state, observer


def partition(wingbeat, cells, harmonics, ranks):
    """Halo cells and edge cut a rank, and imbalance."""
    case = pathlib.Path(__file__).parent.parent / "apps/cases/agard-ct6/case.toml"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [wingbeat, "partition", case, f"mesh.cells=[{cells[0]},{cells[1]}]", f"time.harmonics={harmonics}",
             "solver.flow_method=runge_kutta", "--ranks", str(ranks), "--output", folder], check=True, stdout=subprocess.DEVNULL)
        found = json.loads((pathlib.Path(folder) / "result.json").read_text(encoding="utf-8"))["partition"]
    return found["halo_cells"] / ranks, 2 * found["edge_cut"] / ranks, found["imbalance"]


def levels_of(cells, block):
    """Meshes of the cycle: every block and the mesh itself are halved while they allow it."""
    levels = 1
    while all(side % 2**levels == 0 for side in block) and min(cells) >> levels >= 4:
        levels += 1
    return levels


def block_sides(cells, ranks):
    """Powers of two of ranks only: cut the longer side."""
    sides = list(cells)
    for _ in range(round(math.log2(ranks))):
        longer = 0 if sides[0] >= sides[1] else 1
        sides[longer] //= 2
    return sides


def visits_and_steps(level, levels, cells, recursion):
    """Visits of a mesh in a cycle, and Runge-Kutta steps a visit (flow/multigrid.cpp)."""
    if level == 0:
        return 1, 1
    if level < levels - 1:
        return recursion**level, 2
    return recursion ** (level - 1), max(4, (min(cells) >> level) // 2)


class Model:
    """Seconds of one cycle: computing, and communicating with messages overlapping or in turn."""

    def __init__(self, cells, instances, ranks, halo, faces, imbalance, recursion):
        self.instances = instances
        block = block_sides(cells, ranks)
        self.levels = levels_of(cells, block)
        self.computing = self.at_once = self.in_turn = 0.0
        self.messages = self.exchanges = 0
        for level in range(self.levels):
            visits, steps = visits_and_steps(level, self.levels, cells, recursion)
            sides = [side >> level for side in block]
            # A residual there and on the next coarser mesh, whose restriction and interpolation
            # cost about another.
            coarser = level < self.levels - 1
            stages = visits * (STAGES * steps + 2 * coarser)
            number, around = sides[0] * sides[1], 2 * sum(sides)
            self.computing += stages * instances * 1e-9 * (1 + imbalance) * (
                NS_A_CELL * number + NS_A_FACE_OF_THE_BLOCK * around + NS_A_STAGE)
            if ranks == 1:
                continue
            # Where a block is thinner than the layers of ghosts, these lie on as many blocks more.
            neighbours = sum(2 * math.ceil(LAYERS / side) for side in sides)
            ghosts = halo / 2**level
            self.exchange(visits * (STAGES * steps + 3 * coarser), neighbours, ghosts)
            # Ends of lines, one exchange a direction and stage; coefficients once a step.
            for _ in range(DIRECTIONS):
                self.exchange(visits * (STAGES + 1) * steps, 2, faces / 2**level / DIRECTIONS)
        if ranks > 1:
            reductions = REDUCTIONS * 2 * math.ceil(math.log2(ranks)) * LATENCY
            self.at_once += reductions
            self.in_turn += reductions

    def exchange(self, times, neighbours, cells):
        moving = cells * self.instances * VARIABLES * BYTES / BANDWIDTH
        self.at_once += times * (LATENCY + moving)
        self.in_turn += times * (neighbours * LATENCY + moving)
        self.exchanges += times
        self.messages += times * neighbours


def draw(path, rows, first_ranks):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(5.5, 3.6), constrained_layout=True)
    ranks = [row[0] for row in rows]
    axes.plot(ranks, [p / first_ranks for p in ranks], color="0.7", label="ideal")
    axes.fill_between(ranks, [row[2] for row in rows], [row[1] for row in rows], alpha=0.35, label="model")
    axes.set(xscale="log", yscale="log", xlabel="ranks", ylabel=f"speed, {first_ranks} ranks = 1")
    axes.set_xticks(ranks, [str(p) for p in ranks])
    axes.minorticks_off()
    axes.legend(frameon=False)
    figure.savefig(path, dpi=120)


def main():
    plain = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=plain)
    parser.add_argument("wingbeat")
    parser.add_argument("--cells", type=int, nargs=2, default=[4096, 1024])
    parser.add_argument("--harmonics", type=int, default=3)
    parser.add_argument("--ranks", type=int, nargs="+", default=[64, 256, 1024, 4096, 16384],
                        help="powers of two; efficiencies are against the first")
    parser.add_argument("--cycle", choices=["w", "v"], default="w")
    parser.add_argument("--figure")
    options = parser.parse_args()
    if any(p & (p - 1) for p in options.ranks):
        parser.error("--ranks: powers of two only")

    instances = 2 * options.harmonics + 1
    print(f"{options.cells[0]}x{options.cells[1]}, {instances} instances; {options.cycle.upper()} cycle, ms; efficiency against "
          f"{options.ranks[0]} ranks, messages at once and one after another")
    print(f"{'ranks':>6}{'cells':>8}{'meshes':>8}{'halo/cells':>12}{'exchanges':>11}{'computing':>11}"
          f"{'messages':>18}{'efficiency, %':>16}")
    rows, reference = [], None
    for ranks in options.ranks:
        halo, faces, imbalance = partition(options.wingbeat, options.cells, options.harmonics, ranks)
        model = Model(options.cells, instances, ranks, halo, faces, imbalance,
                      2 if options.cycle == "w" else 1)
        cells = options.cells[0] * options.cells[1] / ranks
        times = model.computing + model.at_once, model.computing + model.in_turn
        if reference is None:
            reference = [time * ranks for time in times]
        efficiency = [100 * first / time / ranks for first, time in zip(reference, times)]
        rows.append((ranks, *(e / 100 * ranks / options.ranks[0] for e in efficiency)))
        print(f"{ranks:>6}{cells:>8.0f}{model.levels:>8}{halo / cells:>12.3f}{model.exchanges:>11}"
              f"{1e3 * model.computing:>11.2f}{1e3 * model.at_once:>9.2f} to{1e3 * model.in_turn:>6.2f}"
              f"{efficiency[0]:>9.0f} to {efficiency[1]:>3.0f}")
    if options.figure:
        draw(options.figure, rows, options.ranks[0])


if __name__ == "__main__":
    main()
