#!/usr/bin/env python3
"""What groups of ranks and starts from solved neighbours save on a sweep of 8 points, in one run.

    sweep.py [WINGBEAT] [KEY=VALUE ...]     (default build/release/wingbeat and 128 x 32 cells)

The case is the transonic dip of the paper's section, M = 0.72 to 0.79. Each way is timed twice, by turns; the shorter
time counts.
"""
import os
import subprocess
import sys
import tempfile
import time

from time_verb import ENVIRONMENT

CASE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "apps", "cases", "naca64a010-mach", "case.toml")
POINTS = ["sweep.refine=0", 'sweep.parameters=["flow.mach = 0.72 to 0.79 in 8"]']
WAYS = {
    "one rank": (1, []),
    "two ranks, one group": (2, []),
    "two ranks, two groups": (2, ["--groups", "2"]),
    "one rank, points on their own": (1, ["sweep.continuation=false"]),
}


def seconds(wingbeat, ranks, options):
    with tempfile.TemporaryDirectory() as folder:
        command = ["mpirun", "-n", str(ranks), wingbeat, "sweep", CASE, *POINTS, *options, "--output", folder]
        start = time.monotonic()
        done = subprocess.run(command, capture_output=True, text=True, env=os.environ | ENVIRONMENT)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")
        return time.monotonic() - start


def main():
    wingbeat, *overrides = sys.argv[1:] or ["build/release/wingbeat"]
    overrides = overrides or ["mesh.cells=[128,32]"]
    best = {}
    for _ in range(2):
        for name, (ranks, options) in WAYS.items():
            taken = seconds(wingbeat, ranks, [*overrides, *options])
            best[name] = min(taken, best.get(name, taken))
    print(f"sweep of 8 points, {' '.join(overrides)}; wall seconds, load at the end {os.getloadavg()[0]:.1f}")
    for name, taken in best.items():
        print(f"{name:<44}{taken:>10.1f}")
    two, own = best["two ranks, two groups"], best["one rank, points on their own"]
    print(f"{'one rank / two groups of one':<44}{best['one rank'] / two:>10.2f}")
    print(f"{'one group of two / two groups of one':<44}{best['two ranks, one group'] / two:>10.2f}")
    print(f"{'saved by starts from neighbours':<44}{1.0 - best['one rank'] / own:>10.0%}")


if __name__ == "__main__":
    main()
