#include "core/mesh/airfoil_families.hpp"

#include <cmath>
#include <vector>

#include "core/io/error.hpp"
#include "core/mesh/cubic_spline.hpp"

namespace wingbeat {

namespace {

struct ValueAndSlope {
  double value = 0.0;
  double slope = 0.0;
};

// Half-thickness against t = sqrt(x), odd in t: positive on the upper surface.
ValueAndSlope four_digit_thickness(double thickness, double t) {
  const double u = std::abs(t), u2 = u * u;
  const double scale = 5.0 * thickness;
  const double value = u * (0.2969 + u * (-0.1260 + u2 * (-0.3516 + u2 * (0.2843 - 0.1036 * u2))));
  const double slope =
      0.2969 + u * (-2.0 * 0.1260 + u2 * (-4.0 * 0.3516 + u2 * (6.0 * 0.2843 - 8.0 * 0.1036 * u2)));
  return {std::copysign(scale * value, t), scale * slope};
}

// Camber line y(x): two parabolas that meet with their maximum at `position`.
struct CamberLine {
  double camber = 0.0;
  double position = 0.5;

  double curvature(double x) const {
    const double length = x < position ? position : 1.0 - position;
    return -2.0 * camber / (length * length);
  }
  double slope(double x) const { return curvature(x) * (x - position); }
  double height(double x) const { return camber + 0.5 * curvature(x) * (x - position) * (x - position); }
};

}  // namespace

Airfoil naca_four_digit(const std::string& digits) {
  ensure(digits.size() == 4 && digits.find_first_not_of("0123456789") == std::string::npos,
         "a NACA four-digit section has four digits");
  const double thickness = 0.01 * std::stod(digits.substr(2));
  const int camber_digit = digits[0] - '0', position_digit = digits[1] - '0';
  if (thickness == 0.0)
    throw InputError("airfoil \"naca" + digits +
                     "\": the last two digits are the thickness in % chord and must exceed 00");
  if ((camber_digit == 0) != (position_digit == 0))
    throw InputError(
        "airfoil \"naca" + digits +
        "\": the first digit (camber, % chord) and the second (its position, tenths of the chord) must "
        "both be zero (symmetric section) or both be 1 to 9");
  const CamberLine line{0.01 * camber_digit, camber_digit == 0 ? 0.5 : 0.1 * position_digit};

  return {"naca" + digits, [thickness, line](double t) {
            const double x = t * t, dx = 2.0 * t;
            const auto [half, half_slope] = four_digit_thickness(thickness, t);
            const double slope = line.slope(x), length = std::sqrt(1.0 + slope * slope);
            const double cosine = 1.0 / length, sine = slope / length;
            const double turning = line.curvature(x) * dx / (length * length);  // d(slope angle)/dt
            SectionPoint point;
            point.position = {{x - half * sine, line.height(x) + half * cosine}};
            point.tangent = {{dx - half_slope * sine - half * cosine * turning,
                              slope * dx + half_slope * cosine - half * sine * turning}};
            return point;
          }};
}

Airfoil naca_64a010() {
  const std::vector<double> percent_x = {0,  0.5, 0.75, 1.25, 2.5, 5,  7.5, 10, 15, 20, 25, 30, 35,
                                         40, 45,  50,   55,   60,  65, 70,  75, 80, 85, 90, 95, 100};
  const std::vector<double> percent_y = {0,     0.804, 0.969, 1.225, 1.688, 2.327, 2.805, 3.199, 3.813,
                                         4.272, 4.606, 4.837, 4.968, 4.995, 4.894, 4.684, 4.388, 4.021,
                                         3.597, 3.127, 2.623, 2.103, 1.582, 1.062, 0.541, 0.021};
  constexpr double nose_radius = 0.00687, trailing_edge_half_thickness = 0.00021;
  std::vector<double> root_x, y;
  for (std::size_t i = 0; i < percent_x.size(); ++i) {
    const double x = 0.01 * percent_x[i];
    root_x.push_back(std::sqrt(x));
    y.push_back(0.01 * percent_y[i] - trailing_edge_half_thickness * x);
  }
  y.back() = 0.0;
  const CubicSpline half(root_x, y, {SplineEnd::Kind::slope, std::sqrt(2.0 * nose_radius)},
                         {SplineEnd::Kind::curvature, 0.0});
  return {"naca64a010", [half](double t) {
            const auto [value, slope] = half(std::abs(t));
            return SectionPoint{{{t * t, std::copysign(value, t)}}, {{2.0 * t, slope}}};
          }};
}

}  // namespace wingbeat
