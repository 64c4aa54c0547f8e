#include "adjoint/load_functional.hpp"

#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

Loads<double> scaled(double by, const Loads<double>& loads) {
  return {by * loads.force_x, by * loads.force_y, by * loads.moment};
}

// Weight of instance n in the part of a harmonic that is asked for.
double time_weight(const LoadQuantity& quantity, const TimeSpectral& time, int n) {
  if (quantity.harmonic == 0) return 1.0 / time.instances();
  const double angle = quantity.harmonic * time.phase(n);
  return 2.0 / time.instances() * (quantity.is_imaginary ? -std::sin(angle) : std::cos(angle));
}

}  // namespace

double load_dot(std::span<const Loads<double>> a, std::span<const Loads<double>> b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n)
    sum += a[n].force_x * b[n].force_x + a[n].force_y * b[n].force_y + a[n].moment * b[n].moment;
  return sum;
}

void add_scaled(double scale, const LoadFunctional& functional, LoadFunctional& sum) {
  const auto add = [scale](const std::vector<Loads<double>>& from, std::vector<Loads<double>>& to) {
    to.resize(from.size());
    for (std::size_t n = 0; n < from.size(); ++n) {
      to[n].force_x += scale * from[n].force_x;
      to[n].force_y += scale * from[n].force_y;
      to[n].moment += scale * from[n].moment;
    }
  };
  add(functional.weights, sum.weights);
  add(functional.by_angle, sum.by_angle);
  for (std::size_t k = 0; k < 2; ++k) add(functional.by_axis[k], sum.by_axis[k]);
}

double LoadFunctional::value(std::span<const Loads<double>> loads) const { return load_dot(weights, loads); }

Loads<double> coefficient_weights(LoadCoefficient coefficient, double angle, const Vec<double, 2>& arm) {
  switch (coefficient) {
    case LoadCoefficient::drag:
      return {std::cos(angle), std::sin(angle), 0.0};
    case LoadCoefficient::lift:
      return {-std::sin(angle), std::cos(angle), 0.0};
    case LoadCoefficient::moment:
      return {-arm[1], arm[0], 1.0};
  }
  ensure(false, "unknown load coefficient");
  return {};
}

LoadFunctional load_functional(const LoadQuantity& quantity, const TimeSpectral& time, double angle,
                               std::span<const MotionState> motions, const Vec<double, 2>& axis,
                               const std::optional<Vec<double, 2>>& reference) {
  LoadFunctional functional;
  const bool has_arm = quantity.coefficient == LoadCoefficient::moment && reference;
  for (int n = 0; n < time.instances(); ++n) {
    const double weight = time_weight(quantity, time, n);
    const RigidMotion<double> motion = rigid_motion(motions[static_cast<std::size_t>(n)]);
    const auto turned = [&](double x, double y) { return motion.turned(Vec<double, 2>{{{x, y}}}); };
    const Vec<double, 2> arm = has_arm ? motion.turned(*reference - axis) : Vec<double, 2>{};
    functional.weights.push_back(scaled(weight, coefficient_weights(quantity.coefficient, angle, arm)));
    // Turning the wind axes makes lift of drag: d C_D / d angle = C_L, d C_L / d angle = -C_D.
    Loads<double> by_angle{};
    if (quantity.coefficient == LoadCoefficient::drag)
      by_angle = coefficient_weights(LoadCoefficient::lift, angle, {});
    if (quantity.coefficient == LoadCoefficient::lift)
      by_angle = scaled(-1.0, coefficient_weights(LoadCoefficient::drag, angle, {}));
    functional.by_angle.push_back(scaled(weight, by_angle));
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec<double, 2> arm_change = k == 0 ? turned(-1.0, 0.0) : turned(0.0, -1.0);
      functional.by_axis[k].push_back(
          has_arm ? Loads<double>{-weight * arm_change[1], weight * arm_change[0], 0.0} : Loads<double>{});
    }
  }
  return functional;
}

}  // namespace wingbeat
