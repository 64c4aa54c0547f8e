#!/bin/sh
# Steady flow of the NACA 64A010 from free stream, ten orders, with coarser meshes first and without.
#   benchmarks/steady.sh [BUILD_FOLDER]       (default build/release)
set -eu
cd "$(dirname "$0")/.."
python3 benchmarks/time_verb.py "${1:-build/release}/wingbeat" steady apps/cases/naca64a010/case.toml \
  --set "mesh.cells=[256,64]" flow.mach=0.796 flow.angle_of_attack_deg=1 solver.steady_tolerance=1e-10 \
  --ranks 1 2 --variant "one mesh" solver.coarse_levels=0
