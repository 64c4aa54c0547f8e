#pragma once

#include <array>
#include <vector>

namespace wingbeat {

// dw/dt at level n+1 from the levels n+1, n, ... of a constant step, newest first
// (eq:backward-difference; C. F. Curtiss and J. O. Hirschfelder 1952, doi:10.1073/pnas.38.3.235):
//   dw/dt ~ (sum_k c_k w^{n+1-k}) / dt,  k = 0..order,  exact for polynomials of degree `order`.
struct BackwardDifference {
  // order: 1 to 3. Orders 1 and 2 are A-stable, order 3 is not quite, A(86 degrees).
  explicit BackwardDifference(int formula_order);

  int order;
  std::array<double, 4> c{};
};

// Weights of the newest `levels` levels of a constant step, newest first, with which their polynomial
// gives the next level (eq:extrapolation).
std::vector<double> extrapolation_weights(int levels);

}  // namespace wingbeat
