#!/bin/sh
# Residual evaluation and Jacobian assembly at 512 x 128: two ranks against one.
#   benchmarks/scaling.sh [BUILD_FOLDER]      (default build/release)
# Ranks need a core each; the rounds alternate, so that other load meets both alike.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none OPENBLAS_NUM_THREADS=1

echo "512x128 on 1 and 2 ranks, ms, least of all rounds; load at the start $(cut -d' ' -f1 /proc/loadavg)"
for round in 1 2 3 4 5; do
  for ranks in 1 2; do
    mpirun -n $ranks "$build/benchmarks/scaling"
  done
done | awk '
  { if (!(($1, $2) in wall) || $3 < wall[$1, $2]) wall[$1, $2] = $3
    if (!(($1, $2) in cpu) || $4 < cpu[$1, $2]) cpu[$1, $2] = $4 }
  function row(kernel, clock, time) {
    printf "%-10s %-10s %9.3f %9.3f %8.2f\n", kernel, clock, 1e3 * time[kernel, 1], 1e3 * time[kernel, 2],
           time[kernel, 1] / time[kernel, 2]
  }
  END {
    printf "%-21s %9s %9s %8s\n", "", "1 rank", "2 ranks", "ratio"
    row("residual", "wall", wall); row("residual", "CPU", cpu)
    row("jacobian", "wall", wall); row("jacobian", "CPU", cpu)
  }'
