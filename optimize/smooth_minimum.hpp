#pragma once

#include <span>
#include <vector>

namespace wingbeat {

struct SmoothMinimum {
  double value = 0.0;
  std::vector<double> derivatives;  // by each number: weights, positive, of sum 1
};

// -(r/rho) ln sum exp(-rho v_i/r), for rho = `sharpness` > 0 and r = `reference` > 0, which must stay the
// same while the v_i vary: smooth, no more than min v_i and no less than min v_i - r ln(n)/rho. Does not
// overflow. G. Kreisselmeier, R. Steinhauser, IFAC Proc. 12 (1979), doi 10.1016/S1474-6670(17)65584-8.
SmoothMinimum smooth_minimum(std::span<const double> values, double sharpness, double reference);

}  // namespace wingbeat
