#include "core/mesh/cubic_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wingbeat {
namespace {

std::vector<double> uneven_knots() { return {-1.0, -0.7, -0.55, 0.0, 0.1, 0.6, 1.3}; }

double cubic(double x) { return 0.3 + x * (-1.1 + x * (0.7 + 2.0 * x)); }
double cubic_slope(double x) { return -1.1 + x * (1.4 + 6.0 * x); }

std::vector<double> cubic_values() {
  std::vector<double> values;
  for (const double x : uneven_knots()) values.push_back(cubic(x));
  return values;
}

TEST(CubicSpline, EveryEndConditionReproducesACubic) {
  using Kind = SplineEnd::Kind;
  const auto curvature = [](double x) { return 1.4 + 12.0 * x; };
  for (const SplineEnd first :
       {SplineEnd{}, {Kind::slope, cubic_slope(-1.0)}, {Kind::curvature, curvature(-1.0)}})
    for (const SplineEnd last :
         {SplineEnd{}, {Kind::slope, cubic_slope(1.3)}, {Kind::curvature, curvature(1.3)}}) {
      const CubicSpline spline(uneven_knots(), cubic_values(), first, last);
      for (double x = -1.0; x <= 1.3; x += 0.09) {
        EXPECT_NEAR(spline(x).value, cubic(x), 1e-14);
        EXPECT_NEAR(spline(x).slope, cubic_slope(x), 1e-13);
      }
    }
}

TEST(CubicSpline, ErrorFallsWithTheFourthPowerOfTheSpacing) {
  const auto error = [](int intervals) {
    std::vector<double> knots, values;
    for (int i = 0; i <= intervals; ++i) {
      knots.push_back(static_cast<double>(i) / intervals);
      values.push_back(std::sin(3.0 * knots.back()));
    }
    const CubicSpline spline(knots, values);
    double worst = 0.0;
    for (double x = 0.0; x < 1.0; x += 0.001)
      worst = std::max(worst, std::abs(spline(x).value - std::sin(3.0 * x)));
    return worst;
  };
  EXPECT_GT(std::log2(error(40) / error(80)), 3.8);
}

}  // namespace
}  // namespace wingbeat
