#include "apps/sweep/sweep_branches.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace wingbeat {
namespace {

// Frequencies of coupled modes differ by more than this part; speeds rise steeply where a branch bends.
constexpr double frequency_reach = 0.15, speed_reach = 0.5;

struct Branch {
  int number;
  double place;
  SweptRoot last;
  std::optional<SweptRoot> slope;  // per unit of the parameter
};

SweptRoot carried_on(const Branch& branch, double place) {
  if (!branch.slope) return branch.last;
  const double step = place - branch.place;
  return {branch.last.reduced_velocity + step * branch.slope->reduced_velocity,
          branch.last.frequency_ratio + step * branch.slope->frequency_ratio};
}

// How far a root is from where a branch leads, 1: out of reach. The nearer of carried on and not.
double distance(const Branch& branch, double place, const SweptRoot& root) {
  double nearest = 2.0;
  for (const SweptRoot& expected : {branch.last, carried_on(branch, place)}) {
    const double frequency = std::abs(root.frequency_ratio / expected.frequency_ratio - 1.0);
    const double speed = std::abs(root.reduced_velocity / expected.reduced_velocity - 1.0);
    nearest = std::min(nearest, std::max(frequency / frequency_reach, speed / speed_reach));
  }
  return nearest;
}

}  // namespace

std::vector<std::vector<int>> linked_branches(std::span<const double> places,
                                              const std::vector<std::vector<SweptRoot>>& roots) {
  std::vector<std::vector<int>> numbers(roots.size());
  std::vector<Branch> branches;
  int count = 0;
  for (std::size_t point = 0; point < roots.size(); ++point) {
    numbers[point].assign(roots[point].size(), 0);
    std::vector<Branch> next = branches;
    std::vector<bool> is_taken(branches.size(), false);
    // The nearest pair first, until none is in reach.
    while (true) {
      double least = 1.0;
      std::optional<std::pair<std::size_t, std::size_t>> pair;
      for (std::size_t b = 0; b < branches.size(); ++b)
        for (std::size_t r = 0; r < roots[point].size(); ++r) {
          if (is_taken[b] || numbers[point][r] != 0) continue;
          const double own = distance(branches[b], places[point], roots[point][r]);
          if (own >= least) continue;
          least = own;
          pair = {b, r};
        }
      if (!pair) break;
      const auto [b, r] = *pair;
      const SweptRoot& root = roots[point][r];
      const double step = places[point] - branches[b].place;
      numbers[point][r] = branches[b].number;
      is_taken[b] = true;
      next[b] = {branches[b].number, places[point], root,
                 SweptRoot{(root.reduced_velocity - branches[b].last.reduced_velocity) / step,
                           (root.frequency_ratio - branches[b].last.frequency_ratio) / step}};
    }
    for (std::size_t r = 0; r < roots[point].size(); ++r)
      if (numbers[point][r] == 0) {
        numbers[point][r] = ++count;
        next.push_back({count, places[point], roots[point][r], std::nullopt});
      }
    branches = std::move(next);
  }
  return numbers;
}

}  // namespace wingbeat
