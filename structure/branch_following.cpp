#include "structure/branch_following.hpp"

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

// A match is clear where the chosen distance is below this fraction of the next.
constexpr double clear_fraction = 0.25;

struct Pair {
  double distance;
  int branch;
  int candidate;
};

}  // namespace

BranchMatch match_branches(std::span<const std::complex<double>> predicted,
                           std::span<const std::complex<double>> candidates) {
  ensure(candidates.size() >= predicted.size(), "fewer eigenvalues than branches to follow");
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < predicted.size(); ++i)
    for (std::size_t j = 0; j < candidates.size(); ++j)
      pairs.push_back({std::abs(predicted[i] - candidates[j]), static_cast<int>(i), static_cast<int>(j)});
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.distance < b.distance; });

  BranchMatch match;
  match.candidate.assign(predicted.size(), -1);
  std::vector<double> chosen(predicted.size(), 0.0);
  std::vector<bool> taken(candidates.size(), false);
  for (const Pair& pair : pairs) {
    const auto i = static_cast<std::size_t>(pair.branch);
    const auto j = static_cast<std::size_t>(pair.candidate);
    if (match.candidate[i] >= 0 || taken[j]) continue;
    match.candidate[i] = pair.candidate;
    chosen[i] = pair.distance;
    taken[j] = true;
  }
  match.is_clear = std::none_of(pairs.begin(), pairs.end(), [&](const Pair& pair) {
    const auto i = static_cast<std::size_t>(pair.branch);
    return pair.candidate != match.candidate[i] && chosen[i] > clear_fraction * pair.distance;
  });
  return match;
}

}  // namespace wingbeat
