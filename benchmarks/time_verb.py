#!/usr/bin/env python3
"""Runs a verb of wingbeat several times and prints where the time went.

    time_verb.py WINGBEAT VERB CASE [--ranks N ...] [--rounds R] [--set KEY=VALUE ...]
                                    [--variant NAME KEY=VALUE ...] ... [--other NAME VERB KEY=VALUE ...] ...

One column for each number of ranks, variant or other verb (with its flags, in one word); the first
is the one that the others are compared with. Wall seconds are those of result.json, of the quickest of R rounds; the rounds go through all
columns in turn, so that other load on the machine meets them alike. CPU seconds, of all processes,
are the least of the rounds: they suffer less from other load. Peak memory is that of the largest
process.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OPENBLAS_NUM_THREADS": "1",
}


def run(wingbeat, verb, case, ranks, overrides):
    """Wall seconds by part, CPU seconds, and peak memory of the largest process in bytes."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
        command += [wingbeat, *verb.split(), case, *overrides, "--output", folder]
        process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=os.environ | ENVIRONMENT
        )
        output = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            sys.exit(f"{' '.join(command)} failed:\n{output}")
        with open(os.path.join(folder, "result.json"), encoding="utf-8") as file:
            wall = json.load(file)["wall_seconds"]
    return wall, usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss


def main():
    plain = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=plain)
    parser.add_argument("wingbeat")
    parser.add_argument("verb")
    parser.add_argument("case")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--set", nargs="+", default=[], metavar="KEY=VALUE", help="overrides of every column")
    parser.add_argument("--variant", nargs="+", action="append", default=[], metavar="WORD",
                        help="name of a further column and its overrides")
    parser.add_argument("--other", nargs="+", action="append", default=[], metavar="WORD",
                        help="name of a further column, its verb and its overrides")
    options = parser.parse_args()

    verb = options.verb
    columns = {f"{n} rank{'s' if n > 1 else ''}": (n, verb, options.set) for n in options.ranks}
    for name, *overrides in options.variant:
        columns[name] = (options.ranks[0], verb, options.set + overrides)
    for name, other, *overrides in options.other:
        columns[name] = (options.ranks[0], other, options.set + overrides)

    best, least_cpu = {}, {}
    for _ in range(options.rounds):
        for name, (ranks, verb, overrides) in columns.items():
            seconds, cpu, memory = run(options.wingbeat, verb, options.case, ranks, overrides)
            least_cpu[name] = min(cpu, least_cpu.get(name, cpu))
            if name not in best or seconds["total"] < best[name][0]["total"]:
                best[name] = seconds, memory

    print(f"{' '.join([options.verb, *options.set])}: wall seconds, best of {options.rounds}; "
          f"load at the end {os.getloadavg()[0]:.1f}")
    print(f"{'':<28}" + "".join(f"{name:>16}" for name in columns))
    parts = list(dict.fromkeys(part for seconds, _ in best.values() for part in seconds))
    for part in parts:
        row = "".join(f"{best[name][0].get(part, 0.0):>16.3f}" for name in columns)
        print(f"{part:<28}{row}")
    print(f"{'CPU, all processes':<28}" + "".join(f"{least_cpu[name]:>16.3f}" for name in columns))
    print(f"{'GB, largest process':<28}" + "".join(f"{best[name][1] * 1e-9:>16.3f}" for name in columns))
    totals = [best[name][0]["total"] for name in columns]
    print(f"{'first column / this one':<28}" + "".join(f"{totals[0] / total:>16.2f}" for total in totals))


if __name__ == "__main__":
    main()
