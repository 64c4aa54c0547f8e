#pragma once

#include <span>
#include <vector>

namespace wingbeat {

// What holds at one end of a cubic spline.
struct SplineEnd {
  enum class Kind { slope, curvature, not_a_knot };
  Kind kind = Kind::not_a_knot;
  double value = 0.0;  // first or second derivative; unused for not_a_knot
};

// Interpolating cubic spline, twice continuously differentiable; beyond the knots the end
// cubics continue. Not-a-knot ends reproduce cubics exactly.
class CubicSpline {
 public:
  struct Value {
    double value = 0.0;
    double slope = 0.0;
  };

  // `knots` strictly increasing, at least 4, one of `values` for each.
  CubicSpline(std::vector<double> knots, std::vector<double> values, SplineEnd first = {},
              SplineEnd last = {});

  Value operator()(double x) const;
  std::span<const double> knots() const { return knots_; }

 private:
  std::vector<double> knots_;
  std::vector<double> values_;
  std::vector<double> curvatures_;  // second derivative at the knots
};

}  // namespace wingbeat
