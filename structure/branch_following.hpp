#pragma once

#include <complex>
#include <span>
#include <vector>

namespace wingbeat {

// Which candidate continues each branch, given where the branches were predicted to be.
struct BranchMatch {
  std::vector<int> candidate;  // of branch i; all different
  // Every branch lies much nearer to its candidate than to any other: the step was short enough.
  bool is_clear = false;
};

// Pairs in order of distance; needs at least as many candidates as predictions.
BranchMatch match_branches(std::span<const std::complex<double>> predicted,
                           std::span<const std::complex<double>> candidates);

}  // namespace wingbeat
