#include "optimize/root_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace wingbeat {
namespace {

constexpr double farthest = 0.3;  // that one root moves between two designs

}  // namespace

double distance(const FlutterRoot& a, const FlutterRoot& b) {
  return std::max(std::abs(a.reduced_velocity / b.reduced_velocity - 1.0),
                  std::abs(a.frequency / b.frequency - 1.0));
}

std::optional<FlutterRoot> RootTracker::follow(const std::vector<FlutterRoot>& roots) {
  std::vector<FlutterRoot> left;
  for (const FlutterRoot& root : roots)
    if (root.is_destabilising()) left.push_back(root);
  std::ranges::sort(left, {}, &FlutterRoot::reduced_velocity);
  if (known_.empty() && !left.empty()) known_.push_back(left.front());
  // The closest pair first: a root that is lost must not take its neighbour's place.
  std::vector<std::size_t> lost(known_.size());
  std::iota(lost.begin(), lost.end(), std::size_t{0});
  while (!lost.empty() && !left.empty()) {
    double closest = std::numeric_limits<double>::infinity();
    std::size_t of_lost = 0, of_left = 0;
    for (std::size_t i = 0; i < lost.size(); ++i)
      for (std::size_t j = 0; j < left.size(); ++j)
        if (const double d = distance(left[j], known_[lost[i]]); d < closest)
          closest = d, of_lost = i, of_left = j;
    if (!(closest <= farthest)) break;
    known_[lost[of_lost]] = left[of_left];
    lost.erase(lost.begin() + static_cast<std::ptrdiff_t>(of_lost));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(of_left));
  }
  has_first_ = !known_.empty() && (lost.empty() || lost.front() != 0);
  next_ratio_.reset();
  if (known_.empty() || left.empty()) return std::nullopt;
  next_ratio_ = left.front().reduced_velocity / known_.front().reduced_velocity;
  if (*next_ratio_ > 1.0 + margin_) return std::nullopt;
  known_.push_back(left.front());
  return known_.back();
}

}  // namespace wingbeat
