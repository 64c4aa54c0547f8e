#!/bin/sh
# Limit cycles of the paper's section from nothing: a branch up to a pitch of 2.6 degrees with three
# harmonics, on two ranks and on one; and one cycle with one to six harmonics.
#   benchmarks/lco.sh [BUILD_FOLDER] [ROUNDS]     (default build/release and 1)
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
rounds=${2:-1}
time_lco() {
  python3 benchmarks/time_verb.py "$build/wingbeat" lco apps/cases/naca64a010/case.toml --rounds "$rounds" "$@"
}
for cells in 128,32 250,50; do
  time_lco --ranks 2 1 --set "mesh.cells=[$cells]" time.harmonics=3 'lco.energies=[1e-6,5e-4,2e-3,5e-3,1e-2,2e-2]'
done
time_lco --ranks 2 --set 'mesh.cells=[128,32]' 'lco.energies=[1e-6,5e-3]' \
  --variant 'N_H = 2' time.harmonics=2 --variant 'N_H = 3' time.harmonics=3 \
  --variant 'N_H = 4' time.harmonics=4 --variant 'N_H = 5' time.harmonics=5 \
  --variant 'N_H = 6' time.harmonics=6
