#include "structure/g_method.hpp"

#include <cmath>
#include <complex>

#include "structure/mode_following.hpp"

namespace wingbeat {

PkResult g_method(const StructureModel& model, const AerodynamicTable& table,
                  std::span<const double> reduced_velocities, const PkOptions& options) {
  check(model);
  const double k_min = table.k_min(), k_max = table.k_max();
  const Eigen::MatrixXd inverse_mass =
      model.mass.llt().solve(Eigen::MatrixXd::Identity(model.size(), model.size()));
  const AerodynamicMatrix q = [&](double k) { return table(k); };
  // dQ/dk is odd where Q is even.
  const auto derivative = [&](double k) -> Eigen::MatrixXcd {
    const double size = std::abs(k);
    if (size < k_min || size > k_max) return Eigen::MatrixXcd::Zero(model.size(), model.size());
    const Eigen::MatrixXcd value = table.derivative(size);
    return k < 0.0 ? Eigen::MatrixXcd(-value.conjugate()) : value;
  };
  // With g = (p - 2 i V k)/(2V) the equation stays quadratic in p.
  const SpectrumAt spectrum = [&](double velocity, double k) {
    const Eigen::MatrixXcd slope = derivative(k);
    const double load = model.load(velocity);
    const std::complex<double> rate(0.0, load / (2.0 * velocity));
    return motion_spectrum(inverse_mass, model.damping + rate * slope,
                           model.stiffness - load * (held(q, k, k_min, k_max) - k * slope));
  };
  return follow_modes(model, spectrum, k_min, k_max, reduced_velocities, options);
}

}  // namespace wingbeat
