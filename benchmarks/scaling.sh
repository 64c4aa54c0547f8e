#!/bin/sh
# Residual evaluation and Jacobian assembly at 512 x 128: two ranks against one.
#   benchmarks/scaling.sh [BUILD_FOLDER]      (default build/release)
# Ranks need a core each; the rounds alternate, so that other load meets both alike.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none OPENBLAS_NUM_THREADS=1

echo "512x128 on 1 and 2 ranks, wall time, least of all rounds; load at the start $(cut -d' ' -f1 /proc/loadavg)"
for round in 1 2 3 4 5; do
  for ranks in 1 2; do
    mpirun -n $ranks "$build/benchmarks/scaling"
  done
done | awk '
  { if (!($1 in residual) || $2 < residual[$1]) residual[$1] = $2
    if (!($1 in jacobian) || $3 < jacobian[$1]) jacobian[$1] = $3 }
  END {
    printf "%-10s %12s %12s %8s\n", "", "1 rank, ms", "2 ranks, ms", "ratio"
    printf "%-10s %12.3f %12.3f %8.2f\n", "residual", 1e3 * residual[1], 1e3 * residual[2], residual[1] / residual[2]
    printf "%-10s %12.3f %12.3f %8.2f\n", "jacobian", 1e3 * jacobian[1], 1e3 * jacobian[2], jacobian[1] / jacobian[2]
  }'
