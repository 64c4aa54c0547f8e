#include "core/mesh/conformal_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/io/error.hpp"
#include "core/mesh/near_circle.hpp"

namespace wingbeat {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr int minimum_points = 8192;  // on the circle while iterating
constexpr int oversampling = 8;       // against the points of the mesh
constexpr int maximum_iterations = 500;
constexpr double angle_tolerance = 1e-12;  // radians; round-off next to the trailing edge is 1e-13

bool has_small_factors(int n) {
  for (const int factor : {2, 3, 5})
    while (n % factor == 0) n /= factor;
  return n == 1;
}

// A multiple of the mesh's points, so that they are iterated on, and fast to transform.
int points_on_circle(int around) {
  int multiple = std::max(oversampling, (minimum_points + around - 1) / around);
  while (!has_small_factors(multiple)) ++multiple;
  return multiple * around;
}

// State of the Theodorsen-Garrick iteration at equidistant points of the circle.
struct Correspondence {
  std::vector<double> angle;      // clockwise, on the near circle
  std::vector<double> eccentric;  // the same points on the section
  std::vector<Complex> coefficients;
};

// Series sum_k c_k e^{ik psi} of non-negative frequencies whose real part takes the values given.
std::vector<Complex> analytic_series(const FourierTransform& fourier, const std::vector<Complex>& real_part) {
  const std::size_t n = real_part.size();
  std::vector<Complex> c(n);
  fourier.forward(real_part, c);
  for (std::size_t k = 0; k < n; ++k) c[k] *= (k == 0 || 2 * k == n ? 1.0 : 2.0) / static_cast<double>(n);
  std::fill(c.begin() + static_cast<std::ptrdiff_t>(n / 2 + 1), c.end(), Complex{});
  c[0] = c[0].real();
  return c;
}

// One iteration: from the radii seen at the present angles to the angles conjugate to them.
// Returns the new angles and stores the series.
std::vector<double> conjugate_angles(const NearCircle& curve, const FourierTransform& fourier,
                                     Correspondence& state) {
  const std::size_t n = state.angle.size();
  std::vector<Complex> log_radius(n), series(n);
  log_radius[0] = curve.trailing_edge_log_radius();
  for (std::size_t j = 1; j < n; ++j) log_radius[j] = curve.find(state.angle[j], state.eccentric[j]);
  state.coefficients = analytic_series(fourier, log_radius);
  fourier.backward(state.coefficients, series);
  const double rotation = curve.trailing_edge_angle() + series[0].imag();
  state.coefficients[0] -= Complex(0.0, rotation);
  std::vector<double> angle(n);
  for (std::size_t j = 0; j < n; ++j)
    angle[j] = 2.0 * pi * static_cast<double>(j) / static_cast<double>(n) - series[j].imag() + rotation;
  return angle;
}

}  // namespace

Complex KarmanTrefftz::physical(Complex zeta) const {
  const Complex w = (zeta - 1.0) / (zeta + 1.0);
  const Complex ratio = std::polar(std::pow(std::abs(w), power), power * std::arg(w));
  return focus + (edge - focus) / (1.0 - ratio);
}

ConformalMap::ConformalMap(const Airfoil& airfoil, int around) : fourier_(around) {
  const NearCircle curve(airfoil);
  corner_ = curve.corner();
  centre_ = curve.centre();
  const int n = points_on_circle(around);
  const FourierTransform fourier(n);
  Correspondence state;
  for (int j = 0; j < n; ++j) state.angle.push_back(curve.trailing_edge_angle() + 2.0 * pi * j / n);
  for (int j = 0; j < n; ++j) state.eccentric.push_back(2.0 * pi * j / n);

  // A step in the right direction always exists: the conjugation is skew, so that relaxation
  // converges however steep the radius, if it is small enough.
  double relaxation = 1.0;
  last_correction_ = 2.0 * pi;
  while (last_correction_ > angle_tolerance) {
    if (++iterations_ > maximum_iterations)
      throw InputError(fmt::format(
          "section {}: the map to a circle does not converge (last correction {:.1e} rad after {} "
          "iterations); smooth the ordinates, or use less camber or thickness",
          airfoil.name(), last_correction_, maximum_iterations));
    const std::vector<double> target = conjugate_angles(curve, fourier, state);
    double correction = 0.0;
    for (std::size_t j = 0; j < target.size(); ++j)
      correction = std::max(correction, std::abs(target[j] - state.angle[j]));
    if (correction > last_correction_) relaxation = std::max(0.5 * relaxation, 0.05);
    for (std::size_t j = 0; j < target.size(); ++j)
      state.angle[j] += relaxation * (target[j] - state.angle[j]);
    last_correction_ = correction;
  }
  if (!std::is_sorted(state.angle.begin(), state.angle.end()))
    throw InputError("section " + airfoil.name() + ": its map to a circle folds; smooth the ordinates");

  coefficients_ = std::move(state.coefficients);
  coefficients_.resize(static_cast<std::size_t>(n / 2 + 1));
  for (int k = 0; k < around; ++k)
    wall_parameters_.push_back(k == 0 ? -1.0
                                      : NearCircle::curve_parameter(state.eccentric[k * (n / around)]));
}

double ConformalMap::conformal_radius() const {
  return std::abs(corner_.scale()) * std::exp(coefficients_[0].real());
}

void ConformalMap::ring(double radius, std::span<Complex> z) const {
  const std::size_t n = z.size();
  ensure(n == static_cast<std::size_t>(fourier_.length()) && radius >= 1.0,
         "wrong arguments of ConformalMap::ring");
  // Frequencies that the points cannot tell apart are summed first.
  std::vector<Complex> folded(n), series(n);
  for (std::size_t k = 0; k < coefficients_.size(); ++k) {
    const double decay = std::pow(radius, -static_cast<double>(k));
    if (decay < 1e-20) break;
    folded[k % n] += decay * coefficients_[k];
  }
  fourier_.backward(folded, series);
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = 2.0 * pi * static_cast<double>(k) / static_cast<double>(n);
    z[k] = corner_.physical(centre_ + radius * std::polar(1.0, -angle) * std::exp(series[k]));
  }
}

}  // namespace wingbeat
