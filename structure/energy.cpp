#include "structure/energy.hpp"

#include <complex>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

// States as columns, one an instance.
Eigen::Map<const Eigen::MatrixXd> states(const StructureModel& model, std::span<const double> y) {
  const auto width = static_cast<std::size_t>(2 * model.size());
  ensure(!y.empty() && y.size() % width == 0, "structural state of the wrong size");
  return {y.data(), static_cast<Eigen::Index>(width), static_cast<Eigen::Index>(y.size() / width)};
}

Eigen::MatrixXd fluctuation(const Eigen::MatrixXd& state) {
  return state.colwise() - state.rowwise().mean().eval();
}

// blkdiag(K, M) applied to every column.
Eigen::MatrixXd weigh(const StructureModel& model, const Eigen::MatrixXd& state) {
  const int m = model.size();
  Eigen::MatrixXd weighted(state.rows(), state.cols());
  weighted.topRows(m) = model.stiffness * state.topRows(m);
  weighted.bottomRows(m) = model.mass * state.bottomRows(m);
  return weighted;
}

double mean_energy(const StructureModel& model, const Eigen::MatrixXd& state) {
  return 0.5 * state.cwiseProduct(weigh(model, state)).sum() / static_cast<double>(state.cols());
}

void add_mean_energy_gradient(const StructureModel& model, const Eigen::MatrixXd& state, double scale,
                              std::span<double> gradient) {
  ensure(gradient.size() == static_cast<std::size_t>(state.size()), "energy gradient of the wrong size");
  Eigen::Map<Eigen::MatrixXd>(gradient.data(), state.rows(), state.cols()) +=
      scale / static_cast<double>(state.cols()) * weigh(model, state);
}

}  // namespace

double average_energy(const StructureModel& model, std::span<const double> y) {
  return mean_energy(model, states(model, y));
}

double fluctuating_energy(const StructureModel& model, std::span<const double> y) {
  return mean_energy(model, fluctuation(states(model, y)));
}

void add_average_energy_gradient(const StructureModel& model, std::span<const double> y, double scale,
                                 std::span<double> gradient) {
  add_mean_energy_gradient(model, states(model, y), scale, gradient);
}

void add_fluctuating_energy_gradient(const StructureModel& model, std::span<const double> y, double scale,
                                     std::span<double> gradient) {
  // Taking the mean off is a symmetric projection: the gradient has no mean either.
  add_mean_energy_gradient(model, fluctuation(states(model, y)), scale, gradient);
}

std::vector<double> harmonic_energies(const StructureModel& model, const TimeSpectral& time,
                                      std::span<const double> y) {
  const int width = 2 * model.size();
  const std::vector<std::complex<double>> coefficients = time.harmonics_of(y);
  std::vector<double> energies;
  for (int h = 0; h <= time.harmonics(); ++h) {
    const Eigen::Map<const Eigen::VectorXcd> state(coefficients.data() + h * width, width);
    // A sine carries half the mean square of a constant of the same amplitude.
    const double share = h == 0 ? 1.0 : 0.5;
    energies.push_back(share * (mean_energy(model, state.real()) + mean_energy(model, state.imag())));
  }
  return energies;
}

double highest_harmonic_share(const StructureModel& model, const TimeSpectral& time,
                              std::span<const double> y) {
  return harmonic_energies(model, time, y).back() / fluctuating_energy(model, y);
}

}  // namespace wingbeat
