#pragma once

#include <optional>
#include <vector>

#include "structure/flutter_roots.hpp"

namespace wingbeat {

// How far apart two roots are: relative differences of speed and frequency, the larger.
double distance(const FlutterRoot& a, const FlutterRoot& b);

// Follows the destabilising roots of the linear flutter problem from design to design, and tells of those
// that come near the lowest: the least of several is not differentiable where they meet.
class RootTracker {
 public:
  // A root is near where its speed exceeds that of the first by less than the part `margin` of it, or is
  // lower.
  explicit RootTracker(double margin) : margin_(margin) {}

  // The roots at the next design. Returns one that is near and was not known; it is known from then on.
  std::optional<FlutterRoot> follow(const std::vector<FlutterRoot>& roots);
  // The first root, and those that came near, as seen last; the first is the lowest at the first design.
  const std::vector<FlutterRoot>& known() const { return known_; }
  // Whether the last design had the first root.
  bool has_first() const { return has_first_; }
  // Speed of the lowest root that is not known over that of the first, if there is one.
  std::optional<double> next_ratio() const { return next_ratio_; }

 private:
  double margin_;
  std::vector<FlutterRoot> known_;
  bool has_first_ = false;
  std::optional<double> next_ratio_;
};

}  // namespace wingbeat
