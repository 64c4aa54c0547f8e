#!/bin/sh
# Runge-Kutta multigrid against Newton on one rank: steady flow to ten orders, forced pitch (CT6) of
# three instances on 128 x 32 and of five on 256 x 64 to six.
#   benchmarks/cycles.sh [BUILD_FOLDER] [ROUNDS]      (default build/release and 3)
set -eu
cd "$(dirname "$0")/.."
program=${1:-build/release}/wingbeat
rounds=${2:-3}
compare() { # VERB CASE KEY=VALUE...
  verb=$1; case=$2; shift 2
  python3 benchmarks/time_verb.py "$program" "$verb" "apps/cases/$case/case.toml" --rounds "$rounds" \
    --set "$@" solver.flow_method=newton --variant cycles solver.flow_method=runge_kutta
}
compare steady naca64a010 "mesh.cells=[256,64]" flow.mach=0.796 flow.angle_of_attack_deg=1 \
  solver.steady_tolerance=1e-10
compare pitch agard-ct6 "mesh.cells=[128,32]" time.harmonics=1 solver.flow_tolerance=1e-6
compare pitch agard-ct6 "mesh.cells=[256,64]" time.harmonics=2 solver.flow_tolerance=1e-6
