#!/bin/sh
# The time-spectral method against marching in time: the flutter boundary of the paper's section, and
# the limit cycle at one speed, which the march reaches from a pitch of 2 degrees.
#   benchmarks/march.sh [BUILD_FOLDER] [ROUNDS]     (default build/release and 1)
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
rounds=${2:-1}
time_both() {
  verb=$1 setting=$2 marching=$3
  shift 3
  python3 benchmarks/time_verb.py "$build/wingbeat" "$verb" apps/cases/naca64a010/case.toml --rounds "$rounds" \
    --set 'mesh.cells=[128,32]' "$setting" --other marching "$marching" 'mesh.cells=[128,32]' march.snapshots=0 "$@"
}
time_both flutter time.harmonics=1 'march --find-flutter' march.reduced_velocity=2.8
time_both lco lco.reduced_velocity=3.05 march march.reduced_velocity=3.05 march.until=limit_cycle \
  march.periods=120 march.initial_pitch_deg=2
