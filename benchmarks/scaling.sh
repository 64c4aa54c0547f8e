#!/bin/sh
# Two ranks against one at 512 x 128: residual, Jacobian, and the Runge-Kutta W cycle of seven
# instances; and the cycle with 256 x 128 cells on every rank.
#   benchmarks/scaling.sh [BUILD_FOLDER] [ROUNDS]     (default build/release and 5)
# Ranks need a core each; the rounds alternate, so that other load meets both alike. The ratio of the
# leasts compares the quietest moments of each; the ratios of the rounds show what load does.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
rounds=${2:-5}
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none OPENBLAS_NUM_THREADS=1

echo "1 and 2 ranks, ms, least of $rounds rounds; load at the start $(cut -d' ' -f1 /proc/loadavg)"
for round in $(seq "$rounds"); do
  for ranks in 1 2; do
    mpirun -n $ranks "$build/benchmarks/scaling" | sed "s/^/$round /"
  done
done | awk '
  { if (!(($2, $3) in wall) || $4 < wall[$2, $3]) wall[$2, $3] = $4
    if (!(($2, $3) in cpu) || $5 < cpu[$2, $3]) cpu[$2, $3] = $5
    if ($3 == 1) alone[$2] = $4; else ratios[$2] = ratios[$2] sprintf(" %.2f", alone[$2] / $4) }
  function row(what, clock, time) {
    printf "%-12s %-5s %9.3f %9.3f %8.2f  %s\n", what, clock, 1e3 * time[what, 1], 1e3 * time[what, 2],
           time[what, 1] / time[what, 2], clock == "wall" ? ratios[what] : ""
  }
  END {
    printf "%-18s %9s %9s %8s  %s\n", "", "1 rank", "2 ranks", "ratio", " of each round"
    row("residual", "wall", wall); row("residual", "CPU", cpu)
    row("jacobian", "wall", wall); row("jacobian", "CPU", cpu)
    row("cycle", "wall", wall); row("cycle", "CPU", cpu)
    row("cycle-weak", "wall", wall); row("cycle-weak", "CPU", cpu)
  }'
