#!/bin/sh
# The flutter boundary of the paper's section from nothing: coupled on one rank and on two, and
# staggered on one; on two meshes.
#   benchmarks/flutter.sh [BUILD_FOLDER] [ROUNDS]     (default build/release and 3)
set -eu
cd "$(dirname "$0")/.."
for cells in 250,50 256,64; do
  python3 benchmarks/time_verb.py "${1:-build/release}/wingbeat" flutter apps/cases/naca64a010/case.toml \
    --rounds "${2:-3}" --set "mesh.cells=[$cells]" --ranks 1 2 --variant staggered solver.method=staggered
done
