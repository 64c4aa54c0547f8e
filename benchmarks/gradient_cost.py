#!/usr/bin/env python3
"""What a gradient costs by the adjoint and by differences of whole solutions, in one run of
`wingbeat gradient --check`.

    gradient_cost.py [WINGBEAT] [KEY=VALUE ...]     (default build/release/wingbeat and 64 x 16 cells)

The case is the paper's section, 24 bumps. Central differences take two solutions a bump, each begun from that of
the undeformed section and taken on to round-off, which digits of a difference need; one-sided ones would take half.
The adjoint's time has the contraction with the geometry and the bumps in it.
"""
import json
import os
import subprocess
import sys
import tempfile

from time_verb import ENVIRONMENT

CASE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "apps", "cases", "naca64a010", "case.toml")


def main():
    wingbeat, *overrides = sys.argv[1:] or ["build/release/wingbeat"]
    overrides = overrides or ["mesh.cells=[64,16]"]
    with tempfile.TemporaryDirectory() as folder:
        command = [wingbeat, "gradient", CASE, *overrides, "--check", "--output", folder]
        done = subprocess.run(command, capture_output=True, text=True, env=os.environ | ENVIRONMENT)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")
        with open(os.path.join(folder, "result.json"), encoding="utf-8") as file:
            result = json.load(file)
    gradient, seconds = result["gradient"], result["wall_seconds"]
    variables = sum("difference" in entry for entry in gradient["design"])
    if variables == 0:
        sys.exit("nothing was differenced one by one; raise gradient.max_differences")
    by_adjoint, by_differences = seconds["gradient"], gradient["check"]["difference_seconds"]
    print(f"{gradient['objective']}, {variables} variables, {' '.join(overrides)}; wall seconds, "
          f"load at the end {os.getloadavg()[0]:.1f}")
    print(f"{'from nothing to the solution':<44}{seconds['total'] - by_adjoint - seconds['check']:>10.3f}")
    print(f"{'gradient by the adjoint':<44}{by_adjoint:>10.3f}")
    print(f"{'the same by central differences':<44}{by_differences:>10.3f}")
    print(f"{'of which a solution':<44}{by_differences / (2 * variables):>10.3f}")
    print(f"{'differences / adjoint':<44}{by_differences / by_adjoint:>10.1f}")
    print(f"{'greatest departure of the two':<44}{gradient['check']['finite_difference']:>10.1e}")


if __name__ == "__main__":
    main()
