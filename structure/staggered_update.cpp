#include "structure/staggered_update.hpp"

#include <cmath>
#include <complex>

#include "core/io/error.hpp"
#include "structure/energy.hpp"
#include "structure/harmonic_motion.hpp"

namespace wingbeat {

namespace {

constexpr double mean_relaxation = 0.5;

Eigen::Map<const Eigen::MatrixXd> instances(std::span<const double> values, int count) {
  const auto columns = static_cast<Eigen::Index>(count);
  return {values.data(), static_cast<Eigen::Index>(values.size()) / columns, columns};
}

// Values less their mean over the instances.
Eigen::VectorXd fluctuation(std::span<const double> values, int count) {
  const auto state = instances(values, count);
  const Eigen::MatrixXd moving = state.colwise() - state.rowwise().mean().eval();
  return moving.reshaped();
}

// S = omega a - load b + c at given y and f: the fluctuating parts of a, b and c.
struct ResidualTerms {
  Eigen::VectorXd by_omega, by_load, rest;
};

ResidualTerms residual_terms(const StructuralEquation& structure, std::span<const double> y,
                             std::span<const double> f) {
  const int count = structure.time().instances();
  std::vector<double> column(y.size());
  ResidualTerms terms;
  structure.frequency_derivative(y, column);
  terms.by_omega = fluctuation(column, count);
  structure.load_derivative(f, column);
  terms.by_load = -fluctuation(column, count);
  structure.residual(y, 0.0, 0.0, f, column);
  terms.rest = fluctuation(column, count);
  return terms;
}

// What stands for d/dtau: 1/dtau for the fluctuation; (1/theta - 1) A for the mean, so that it is left
// with the fraction theta of its step to equilibrium.
void add_pseudo_time(const StructuralEquation& structure, double dtau, Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(2 * structure.modes(), 2 * structure.modes());
  const Eigen::MatrixXd mean_part =
      (1.0 / mean_relaxation - 1.0) * first_order_matrix(structure.model()) - unit / dtau;
  const int count = structure.time().instances();
  const Eigen::Index width = unit.rows();
  for (int row = 0; row < count; ++row)
    for (int column = 0; column < count; ++column)
      matrix.block(row * width, column * width, width, width) += mean_part / count;
  matrix.diagonal().array() += 1.0 / dtau;
}

}  // namespace

std::vector<double> structural_step(const StructuralEquation& structure, std::span<const double> y,
                                    double omega, double load, std::span<const double> f, double dtau) {
  ensure(dtau > 0.0, "a pseudo-time step must be positive");
  std::vector<double> next(y.size());
  structure.residual(y, omega, load, f, next);
  Eigen::MatrixXd matrix = structure.state_jacobian(y, omega);
  add_pseudo_time(structure, dtau, matrix);
  const auto size = static_cast<Eigen::Index>(y.size());
  Eigen::Map<Eigen::VectorXd> change(next.data(), size);
  change = Eigen::Map<const Eigen::VectorXd>(y.data(), size) - matrix.partialPivLu().solve(change).eval();
  return next;
}

std::vector<double> scaled_to_energy(const StructureModel& model, std::span<const double> y, double energy) {
  const double own = fluctuating_energy(model, y);
  ensure(own > 0.0, "a cycle without energy cannot be scaled");
  const double factor = std::sqrt(energy / own);
  const std::size_t width = static_cast<std::size_t>(2 * model.size());
  const auto state = instances(y, static_cast<int>(y.size() / width));
  const Eigen::VectorXd mean = state.rowwise().mean();
  const Eigen::MatrixXd scaled = (factor * (state.colwise() - mean)).colwise() + mean;
  return {scaled.data(), scaled.data() + scaled.size()};
}

std::vector<double> shifted_to_phase(const StructureModel& model, const TimeSpectral& time,
                                     std::span<const double> y) {
  std::vector<std::complex<double>> coefficients = time.harmonics_of(y);
  const std::size_t width = static_cast<std::size_t>(2 * model.size());
  const std::complex<double> turn = turn_to_sine(model, first_harmonic(model, time, y), model.phase_mode);
  std::complex<double> factor = 1.0;  // turn^h: a shift in time
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (i > 0 && i % width == 0) factor *= turn;
    coefficients[i] *= factor;
  }
  return time.instances_of(coefficients);
}

FrequencyAndLoad fitted_frequency_and_load(const StructuralEquation& structure, std::span<const double> y,
                                           std::span<const double> f) {
  const ResidualTerms terms = residual_terms(structure, y, f);
  const double cross = terms.by_omega.dot(terms.by_load);
  Eigen::Matrix2d normal;
  normal << terms.by_omega.squaredNorm(), -cross, -cross, terms.by_load.squaredNorm();
  const Eigen::Vector2d right(-terms.by_omega.dot(terms.rest), terms.by_load.dot(terms.rest));
  const Eigen::Vector2d solution = normal.partialPivLu().solve(right);
  return {solution[0], solution[1]};
}

double fitted_frequency(const StructuralEquation& structure, std::span<const double> y,
                        std::span<const double> f, double load) {
  const ResidualTerms terms = residual_terms(structure, y, f);
  return terms.by_omega.dot(load * terms.by_load - terms.rest) / terms.by_omega.squaredNorm();
}

}  // namespace wingbeat
