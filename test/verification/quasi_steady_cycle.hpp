#pragma once

// Limit cycles of the quasi-steady section as the problem that Newton solves.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/algebra/continuation.hpp"
#include "structure/conditions.hpp"
#include "structure/flutter_roots.hpp"
#include "structure/harmonic_motion.hpp"
#include "structure/structural_equation.hpp"
#include "test/structure/quasi_steady_model.hpp"

namespace wingbeat::quasi_steady {

// h' = i omega h = 2 i k V h.
inline Eigen::MatrixXcd quasi_steady_matrix(double k) {
  return force_direction.cast<std::complex<double>>() *
         Eigen::RowVector2cd(std::complex<double>(0.0, 2.0 * k), 1.0);
}

inline FlutterRoot hopf_point() {
  const std::vector<double> k = spread_reduced_frequencies(0.05, 2.0, 12);
  const std::vector<FlutterRoot> roots =
      flutter_roots(section({0.0, 0.0}), quasi_steady_matrix, tabulate(quasi_steady_matrix, k));
  return roots.at(0);
}

class DenseOperator final : public LinearOperator<double> {
 public:
  explicit DenseOperator(Eigen::MatrixXd matrix) : matrix_(std::move(matrix)) {}
  std::size_t local_size() const override { return static_cast<std::size_t>(matrix_.rows()); }
  void apply(std::span<const double> x, std::span<double> y) const override { multiply(matrix_, x, y); }
  void apply_transpose(std::span<const double> x, std::span<double> y) const override {
    multiply(matrix_.transpose(), x, y);
  }
  const Eigen::MatrixXd& matrix() const { return matrix_; }

 private:
  static void multiply(const Eigen::MatrixXd& a, std::span<const double> x, std::span<double> y) {
    Eigen::Map<Eigen::VectorXd>(y.data(), a.rows()) =
        a * Eigen::Map<const Eigen::VectorXd>(x.data(), a.cols());
  }
  Eigen::MatrixXd matrix_;
};

// Unknowns (y, omega, V); rows (S, Y, by_amplitude (first harmonic of pitch/A_0 - 1) + by_speed (V/V_0 - 1)).
class LimitCycle final : public Problem {
 public:
  LimitCycle(const StructureModel& model, int harmonics, double amplitude)
      : LimitCycle(model, harmonics, BranchRow{.amplitude = amplitude}) {}
  LimitCycle(const StructureModel& model, int harmonics, const BranchRow& row)
      : structure_(model, TimeSpectral(harmonics)),
        phase_(phase_condition(model, structure_.time())),
        amplitude_(first_harmonic_condition(model, structure_.time(), pitch_mode, row.amplitude)),
        row_(row),
        jacobian_(Eigen::MatrixXd::Zero(size(), size())),
        inverse_(jacobian_) {}

  std::vector<double> start(const FlutterRoot& root, double amplitude) const {
    const Eigen::VectorXcd mode = scaled_to_amplitude(structure_.model(), root.mode, pitch_mode, amplitude);
    std::vector<double> u = harmonic_states(structure_.model(), structure_.time(), mode, root.frequency);
    u.push_back(root.frequency);
    u.push_back(root.reduced_velocity);
    return u;
  }

  std::size_t local_size() const override { return structure_.state_size() + 2; }

  bool residual(std::span<const double> u, std::span<double> f) override {
    const std::span<const double> y = u.first(states());
    const double velocity = u[states() + 1];
    structure_.residual(y, u[states()], structure_.model().load(velocity), forces(y, velocity),
                        f.first(states()));
    f[states()] = value(phase_, y);
    f[states() + 1] =
        row_.by_amplitude * value(amplitude_, y) + row_.by_speed * (velocity / row_.speed - 1.0);
    return true;
  }

  void linearize(std::span<const double> u) override {
    const std::span<const double> y = u.first(states());
    const double omega = u[states()];
    const double velocity = u[states() + 1];
    const double load = structure_.model().load(velocity);
    const auto n = static_cast<Eigen::Index>(states());
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(n + 2, n + 2);
    jacobian.topLeftCorner(n, n) = structure_.state_jacobian(y, omega);
    std::vector<double> unit(states(), 0.0), column(states());
    for (std::size_t j = 0; j < states(); ++j) {
      unit[j] = 1.0;
      std::fill(column.begin(), column.end(), 0.0);
      structure_.add_force_tangent(load, forces(unit, velocity), 1.0, column);
      jacobian.col(static_cast<Eigen::Index>(j)).head(n) += map(column);
      unit[j] = 0.0;
    }
    structure_.frequency_derivative(y, column);
    jacobian.col(n).head(n) = map(column);
    structure_.load_derivative(forces(y, velocity), column);
    jacobian.col(n + 1).head(n) = 2.0 * load / velocity * map(column);
    std::fill(column.begin(), column.end(), 0.0);
    structure_.add_force_tangent(load, forces_by_velocity(y, velocity), 1.0, column);
    jacobian.col(n + 1).head(n) += map(column);
    std::vector<double> row(states(), 0.0);
    add_gradient(phase_, y, 1.0, row);
    jacobian.row(n).head(n) = map(row).transpose();
    std::fill(row.begin(), row.end(), 0.0);
    add_gradient(amplitude_, y, row_.by_amplitude, row);
    jacobian.row(n + 1).head(n) = map(row).transpose();
    jacobian(n + 1, n + 1) = row_.by_speed / row_.speed;
    jacobian_ = DenseOperator(std::move(jacobian));
  }

  const LinearOperator<double>& jacobian() const override { return jacobian_; }
  const Eigen::MatrixXd& jacobian_matrix() const { return jacobian_.matrix(); }
  void refactor() override {
    inverse_ = DenseOperator(jacobian_.matrix().inverse());
    is_factored_ = true;
  }
  bool is_factored() const override { return is_factored_; }
  const LinearOperator<double>& preconditioner() const override { return inverse_; }
  double excess(std::span<const double> f) const override {
    double largest = 0.0;
    for (double value : f) largest = std::max(largest, std::abs(value));
    return largest / 1e-14;
  }

  // First harmonic of pitch of a state without cosine.
  double amplitude(std::span<const double> u) const {
    return row_.amplitude * (value(amplitude_, u.first(states())) + 1.0);
  }

  // dV/d(mass ratio, k3) of the cycle u, at constant amplitude.
  Eigen::Vector2d velocity_gradient(std::span<const double> u) {
    linearize(u);
    const std::span<const double> y = u.first(states());
    const double velocity = u[states() + 1];
    const auto n = static_cast<Eigen::Index>(states());
    Eigen::MatrixXd by_parameter = Eigen::MatrixXd::Zero(n + 2, 2);
    std::vector<double> column(states());
    structure_.load_derivative(forces(y, velocity), column);
    by_parameter.col(0).head(n) = -structure_.model().load(velocity) / mass_ratio * map(column);
    std::vector<double> spring(structure_.force_size(), 0.0);
    for (std::size_t i = 0; i < spring.size(); i += 2)
      spring[i + 1] = gyration_radius_squared * std::pow(y[2 * i + 1], 3);
    std::fill(column.begin(), column.end(), 0.0);
    structure_.add_force_tangent(1.0, spring, -1.0, column);
    by_parameter.col(1).head(n) = map(column);
    return -jacobian_.matrix().partialPivLu().solve(by_parameter).row(n + 1).transpose();
  }

 private:
  static Eigen::Map<const Eigen::VectorXd> map(const std::vector<double>& v) {
    return {v.data(), static_cast<Eigen::Index>(v.size())};
  }
  Eigen::Index size() const { return static_cast<Eigen::Index>(local_size()); }
  std::size_t states() const { return structure_.state_size(); }

  std::vector<double> forces(std::span<const double> y, double velocity) const {
    return along_force_direction(y, [=](double alpha, double rate) { return alpha + rate / velocity; });
  }
  std::vector<double> forces_by_velocity(std::span<const double> y, double velocity) const {
    return along_force_direction(y, [=](double, double rate) { return -rate / (velocity * velocity); });
  }
  template <class Incidence>
  std::vector<double> along_force_direction(std::span<const double> y, Incidence incidence) const {
    std::vector<double> f;
    for (std::size_t i = 0; i < y.size(); i += 4)
      for (int j = 0; j < 2; ++j)
        f.push_back(force_direction[j] * incidence(y[i + pitch_mode], y[i + 2 + plunge_mode]));
    return f;
  }

  StructuralEquation structure_;
  HarmonicCondition phase_;
  AmplitudeCondition amplitude_;
  BranchRow row_;
  DenseOperator jacobian_;
  DenseOperator inverse_;
  bool is_factored_ = false;
};

}  // namespace wingbeat::quasi_steady
