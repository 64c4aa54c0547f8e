#pragma once

#include <functional>

namespace wingbeat {

// Force g(u) that the spring of one mode adds to its linear part, with its derivative g'(u).
struct RestoringForce {
  int mode = 0;
  std::function<double(double)> value;
  std::function<double(double)> derivative;
};

// g(u) = cubic u^3 + quintic u^5                                                  (eq:polynomial-spring)
RestoringForce polynomial_spring(int mode, double cubic, double quintic);

// What turns a linear spring of this stiffness into one with a dead zone |u| < gap:
// g(u) = -stiffness c(u), c odd and smooth, c -> u well inside and c -> +-gap well outside; the corners
// are rounded over smoothing * gap                                                (eq:freeplay-spring)
// Throws InputError unless gap > 0 and smoothing > 0.
RestoringForce freeplay_spring(int mode, double stiffness, double gap, double smoothing);

}  // namespace wingbeat
