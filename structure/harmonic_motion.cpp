#include "structure/harmonic_motion.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/io/error.hpp"
#include "structure/imaginary_unit.hpp"

namespace wingbeat {

namespace {

using Complex = std::complex<double>;

}  // namespace

Complex turn_to_sine(const StructureModel& model, const Eigen::VectorXcd& u_hat, int mode) {
  const double size = std::abs(u_hat[mode]);
  if (!(size > 1e-12 * u_hat.norm()))
    throw InputError(
        fmt::format("mode '{}' does not move in this cycle and cannot set its phase; choose another",
                    model.modes[static_cast<std::size_t>(mode)]));
  return -i_unit * std::conj(u_hat[mode]) / size;
}

std::vector<double> harmonic_states(const StructureModel& model, const TimeSpectral& time,
                                    const Eigen::VectorXcd& u_hat, double omega) {
  const int m = model.size();
  ensure(u_hat.size() == m, "mode shape of the wrong size");
  Eigen::MatrixXd states(2 * m, time.instances());
  for (int n = 0; n < time.instances(); ++n) {
    const Complex rotation = std::polar(1.0, time.phase(n));
    states.col(n).head(m) = (u_hat * rotation).real();
    states.col(n).tail(m) = (u_hat * (i_unit * omega * rotation)).real();
  }
  return {states.data(), states.data() + states.size()};
}

Eigen::VectorXcd scaled_to_energy(const StructureModel& model, const Eigen::VectorXcd& u_hat, double omega,
                                  double energy) {
  const Complex turn = turn_to_sine(model, u_hat, model.phase_mode);
  const Eigen::MatrixXd weight = model.stiffness + omega * omega * model.mass;
  const double own = 0.25 * u_hat.dot(weight * u_hat).real();
  ensure(own > 0.0, "a cycle without energy cannot be scaled");
  return u_hat * (turn * std::sqrt(energy / own));
}

Eigen::VectorXcd scaled_to_amplitude(const StructureModel& model, const Eigen::VectorXcd& u_hat, int mode,
                                     double amplitude) {
  return u_hat * (turn_to_sine(model, u_hat, mode) * (amplitude / std::abs(u_hat[mode])));
}

Eigen::VectorXcd first_harmonic(const StructureModel& model, const TimeSpectral& time,
                                std::span<const double> y) {
  ensure(time.harmonics() >= 1, "no first harmonic in one instance");
  const std::vector<Complex> coefficients = time.harmonics_of(y);
  return Eigen::Map<const Eigen::VectorXcd>(coefficients.data() + 2 * model.size(), model.size());
}

}  // namespace wingbeat
