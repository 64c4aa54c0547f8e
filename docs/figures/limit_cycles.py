"""Draws limit-cycles.png: energy against speed and frequency by one to five harmonics, and by marching in time.

Usage: python3 limit_cycles.py RUNS, where RUNS holds folders of wingbeat lco with time.harmonics = 1 to 5, 'mesh.cells=[128,32]'
and 'lco.energies=[1e-6,5e-3,1e-2,2e-2]', and of wingbeat march --restart from their cycles.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "apps" / "plots"))

from branch import draw_branches, limit_cycles, read_branch  # noqa: E402
from runs import branch_looks  # noqa: E402

LARGEST = 0.021  # energy shown


def main(runs):
    folders = sorted(path.parent for path in runs.glob("*/result.json"))
    branches = [folder for folder in folders if read_branch(folder) is not None]
    figure = draw_branches(branches, branch_looks(branches), limit_cycles(folders))
    for axes, limits in zip(figure.axes, ((2.87, 3.27), (0.645, 0.683))):
        axes.set(xlim=limits, ylim=(0.0, LARGEST))
    figure.savefig(HERE / "limit-cycles.png", dpi=80)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
