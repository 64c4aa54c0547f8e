#include "core/mesh/near_circle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr std::size_t table_size = 2048;

double table_angle(std::size_t i) { return 2.0 * pi * (static_cast<double>(i) + 0.5) / table_size; }

Complex complex_of(const Vec<double, 2>& a) { return {a[0], a[1]}; }

// The value of `angle` modulo 2 pi that is nearest to `reference`.
double unwrapped(double angle, double reference) {
  return angle + 2.0 * pi * std::round((reference - angle) / (2.0 * pi));
}

KarmanTrefftz corner_of(const Airfoil& airfoil) {
  const SectionPoint nose = airfoil.at(0.0);
  const Complex inwards = complex_of(nose.tangent) * Complex(0.0, -1.0) / std::abs(complex_of(nose.tangent));
  // A radius outside these bounds serves no purpose: the focus only has to lie just behind the nose.
  const double radius = std::clamp(airfoil.nose_radius(), 1e-5, 0.5);
  // Interpolation leaves a cusp with an angle of either sign.
  const double angle = std::max(airfoil.trailing_edge_angle(), 0.0);
  return {complex_of(airfoil.at(-1.0).position), complex_of(nose.position) + 0.5 * radius * inwards,
          2.0 - angle / pi};
}

}  // namespace

NearCircle::NearCircle(const Airfoil& airfoil) : airfoil_(airfoil), corner_(corner_of(airfoil)) {
  tabulate_branch();
  find_centre();
  check_star_shaped();
}

// Continued along the section from the nose, where both differences point forwards.
void NearCircle::tabulate_branch() {
  branch_.resize(table_size);
  for (std::size_t i = 0; i < table_size; ++i) {
    const Complex z = complex_of(airfoil_.at(curve_parameter(table_angle(i))).position);
    branch_[i] = std::arg((z - corner_.edge) / (z - corner_.focus));
  }
  constexpr std::size_t nose = table_size / 2;
  for (std::size_t i = nose + 1; i < table_size; ++i) branch_[i] = unwrapped(branch_[i], branch_[i - 1]);
  for (std::size_t i = nose; i-- > 0;) branch_[i] = unwrapped(branch_[i], branch_[i + 1]);
}

NearCircle::Image NearCircle::image(double eccentric) const {
  const SectionPoint point = airfoil_.at(curve_parameter(eccentric));
  const Complex z = complex_of(point.position);
  const Complex dz = complex_of(point.tangent) * (0.5 * std::sin(0.5 * eccentric));
  const Complex to_edge = z - corner_.edge, to_focus = z - corner_.focus;
  const Complex ratio = to_edge / to_focus;
  const double position = std::clamp(eccentric / (2.0 * pi) * table_size, 0.0, table_size - 1.0);
  const double argument = unwrapped(std::arg(ratio), branch_[static_cast<std::size_t>(position)]);
  const Complex w = std::polar(std::pow(std::abs(ratio), 1.0 / corner_.power), argument / corner_.power);
  const Complex dw = w / corner_.power * dz * (1.0 / to_edge - 1.0 / to_focus);
  return {(1.0 + w) / (1.0 - w), 2.0 * dw / ((1.0 - w) * (1.0 - w))};
}

// Centroid of the curve as a wire.
void NearCircle::find_centre() {
  Complex sum = 0.0;
  double length = 0.0;
  for (std::size_t i = 0; i < table_size; ++i) {
    const auto [zeta, slope] = image(table_angle(i));
    sum += std::abs(slope) * zeta;
    length += std::abs(slope);
  }
  centre_ = sum / length;
  const Complex edge = 1.0 - centre_;
  trailing_edge_angle_ = -std::arg(edge);
  trailing_edge_log_radius_ = std::log(std::abs(edge));
}

void NearCircle::check_star_shaped() const {
  for (std::size_t i = 0; i < table_size; ++i) {
    if (at(table_angle(i)).angle_slope > 0.0) continue;
    const auto position = airfoil_.at(curve_parameter(table_angle(i))).position;
    throw InputError(
        fmt::format("section {}: cannot be mapped to a circle, its surface folds at x = {:.4g}, y = {:.4g}; "
                    "smooth the ordinates there, or use less camber or thickness",
                    airfoil_.name(), position[0], position[1]));
  }
}

NearCircle::Polar NearCircle::at(double eccentric) const {
  const auto [zeta, slope] = image(eccentric);
  const Complex offset = zeta - centre_;
  return {unwrapped(-std::arg(offset), eccentric), std::log(std::abs(offset)), -(slope / offset).imag()};
}

// Newton's method kept within a bracket: the angle rises monotonically.
double NearCircle::find(double angle, double& eccentric) const {
  constexpr double tolerance = 1e-8;  // the step after this one is beneath round-off
  double low = 0.0, high = 2.0 * pi;
  for (int step = 0; step < 60; ++step) {
    const Polar polar = at(eccentric);
    (polar.angle < angle ? low : high) = eccentric;
    const double newton = eccentric + (angle - polar.angle) / polar.angle_slope;
    const bool converged = std::abs(newton - eccentric) < tolerance * eccentric;
    eccentric = converged || (newton > low && newton < high) ? newton : 0.5 * (low + high);
    if (converged) break;
  }
  return at(eccentric).log_radius;
}

}  // namespace wingbeat
