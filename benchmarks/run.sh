#!/bin/sh
# All benchmarks, one after another, into one table of text.
#   benchmarks/run.sh [BUILD_FOLDER] [TABLE]  (default build/release and BUILD_FOLDER/benchmarks.txt)
# Takes more than half an hour and both cores; meaningful only on a machine that does nothing else.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
table=${2:-$build/benchmarks.txt}
{
  "$build/wingbeat" --version
  sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1
  echo; "$build/benchmarks/kernels"
  echo; benchmarks/scaling.sh "$build"
  echo; benchmarks/steady.sh "$build"
  echo; benchmarks/cycles.sh "$build"
  echo; benchmarks/flutter.sh "$build"
  echo; benchmarks/lco.sh "$build"
  echo; benchmarks/march.sh "$build"
  echo; benchmarks/gradient.sh "$build"
  echo; python3 benchmarks/gradient_cost.py "$build/wingbeat"
  echo; python3 benchmarks/sweep.py "$build/wingbeat"
  echo; python3 benchmarks/scaling_model.py "$build/wingbeat"
} >"$table.part"
mv "$table.part" "$table"
cat "$table"
