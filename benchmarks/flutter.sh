#!/bin/sh
# The flutter boundary of the paper's section from nothing, on one rank and on two.
#   benchmarks/flutter.sh [BUILD_FOLDER]      (default build/release)
set -eu
cd "$(dirname "$0")/.."
python3 benchmarks/time_verb.py "${1:-build/release}/wingbeat" flutter apps/cases/naca64a010/case.toml \
  --ranks 1 2
