#!/bin/sh
# The gradient of the flutter speed from nothing: 24 and 2,400 bumps beside the flutter run without it, with
# one to six harmonics, with exact and incomplete factors, on one rank and two.
#   benchmarks/gradient.sh [BUILD_FOLDER] [ROUNDS]     (default build/release and 3)
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
rounds=${2:-3}
time_gradient() {
  python3 benchmarks/time_verb.py "$build/wingbeat" gradient apps/cases/naca64a010/case.toml --rounds "$rounds" "$@"
}
for cells in 128,32 250,50; do
  time_gradient --ranks 1 2 --set "mesh.cells=[$cells]" --variant '2400 bumps' design.bumps=2400 \
    --variant 'ILU(2)' solver.subdomain=ilu --other flutter flutter
done
time_gradient --set 'mesh.cells=[128,32]' --variant 'N_H = 2' time.harmonics=2 --variant 'N_H = 3' time.harmonics=3 \
  --variant 'N_H = 4' time.harmonics=4 --variant 'N_H = 5' time.harmonics=5 --variant 'N_H = 6' time.harmonics=6
