// Limit cycles of a typical section with quasi-steady aerodynamics and a cubic-quintic pitch spring
// (He, Jonsson & Martins, Nonlinear Dynamics 2022). Its Hopf point is known exactly, its cycles to
// twelve digits from an independent program, through the solver that finds limit cycles in flow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/algebra/newton.hpp"
#include "structure/conditions.hpp"
#include "structure/flutter_roots.hpp"
#include "structure/harmonic_motion.hpp"
#include "structure/structural_equation.hpp"

namespace wingbeat {
namespace {

constexpr int plunge_mode = 0;
constexpr int pitch_mode = 1;

struct Spring {
  double cubic;
  double quintic;
};

constexpr double gyration_radius_squared = 0.09;
constexpr double mass_ratio = 10.0;
constexpr double degree = std::numbers::pi / 180.0;

// Lift and moment follow the effective incidence alpha + h'/V through these, with c = 2/mass_ratio.
const Eigen::Vector2d force_direction(-1.0, 0.2);

StructureModel section(Spring spring) {
  StructureModel model;
  model.modes = {"plunge", "pitch"};
  model.mass.resize(2, 2);
  model.mass << 1.0, 0.2, 0.2, gyration_radius_squared;
  model.damping = Eigen::MatrixXd::Zero(2, 2);
  model.stiffness = Eigen::Vector2d(0.25, gyration_radius_squared).asDiagonal();
  model.load_factor = 2.0 / mass_ratio;
  model.phase_mode = pitch_mode;
  model.restoring = {polynomial_spring(pitch_mode, gyration_radius_squared * spring.cubic,
                                       gyration_radius_squared * spring.quintic)};
  return model;
}

// h' = i omega h = 2 i k V h.
Eigen::MatrixXcd quasi_steady_matrix(double k) {
  return force_direction.cast<std::complex<double>>() *
         Eigen::RowVector2cd(std::complex<double>(0.0, 2.0 * k), 1.0);
}

FlutterRoot hopf_point() {
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

// Unknowns (y, omega, V); rows (S, Y, first harmonic of pitch = A).
class LimitCycle final : public Problem {
 public:
  LimitCycle(const StructureModel& model, int harmonics, double amplitude)
      : structure_(model, TimeSpectral(harmonics)),
        phase_(phase_condition(model, structure_.time())),
        amplitude_(first_harmonic_condition(model, structure_.time(), pitch_mode, amplitude)),
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
    f[states() + 1] = value(amplitude_, y);
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
    add_gradient(amplitude_, y, 1.0, row);
    jacobian.row(n + 1).head(n) = map(row).transpose();
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
  DenseOperator jacobian_;
  DenseOperator inverse_;
  bool is_factored_ = false;
};

struct Cycle {
  double velocity;
  double frequency;
};

// Solves from the linear mode at the Hopf point.
std::vector<double> solve(LimitCycle& problem, double amplitude) {
  std::vector<double> u = problem.start(hopf_point(), amplitude);
  NewtonOptions options;
  options.forcing_max = 1e-3;
  options.refactor_iterations = 4;
  const NewtonResult result = newton(Comm(), problem, u, options);
  EXPECT_EQ(result.status, SolveStatus::converged) << to_string(result.status);
  EXPECT_LE(result.iterations, 10);
  return u;
}

Cycle limit_cycle(Spring spring, int harmonics, double amplitude_deg) {
  LimitCycle problem(section(spring), harmonics, amplitude_deg * degree);
  const std::vector<double> u = solve(problem, amplitude_deg * degree);
  return {u[u.size() - 1], u[u.size() - 2]};
}

TEST(QuasiSteadyLco, HopfPointIsExact) {
  const FlutterRoot root = hopf_point();
  const double exact = 3.0 / std::sqrt(13.0);
  EXPECT_TRUE(root.is_converged);
  EXPECT_TRUE(root.is_destabilising());
  EXPECT_NEAR(root.reduced_velocity, exact, 1e-12);
  EXPECT_NEAR(root.frequency, exact, 1e-12);
}

TEST(QuasiSteadyLco, JacobianAgreesWithDifferencesOfTheResidual) {
  LimitCycle problem(section({-1.5, 50.0}), 2, 0.3);
  std::vector<double> u = problem.start(hopf_point(), 0.3);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += 0.05 * std::sin(3.0 * static_cast<double>(i) + 1.0);
  problem.linearize(u);
  const Eigen::MatrixXd jacobian = problem.jacobian_matrix();
  // Central differences of a quintic, step h: error h^2 f'''/6 + eps/h, about 1e-9.
  const double step = 1e-5;
  std::vector<double> above(u.size()), below(u.size());
  for (std::size_t j = 0; j < u.size(); ++j) {
    std::vector<double> moved = u;
    moved[j] = u[j] + step;
    problem.residual(moved, above);
    moved[j] = u[j] - step;
    problem.residual(moved, below);
    for (std::size_t i = 0; i < u.size(); ++i)
      EXPECT_NEAR(jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                  (above[i] - below[i]) / (2.0 * step), 1e-8)
          << "row " << i << ", column " << j;
  }
}

TEST(QuasiSteadyLco, NineCyclesAgreeToTenDigits) {
  struct Case {
    Spring spring;
    double amplitude_deg;
    Cycle cycle;
  };
  const std::vector<Case> cases = {
      {{1.5, 0.0}, 1.0, {.832192857830, .832192855070}},
      {{1.5, 0.0}, 5.0, {.835610740820, .835609018385}},
      {{1.5, 0.0}, 9.0, {.843558758490, .843540742384}},
      {{-1.5, 0.0}, 1.0, {.831907718689, .831907715929}},
      {{-1.5, 0.0}, 5.0, {.828482249624, .828480522389}},
      {{-1.5, 0.0}, 9.0, {.820462056318, .820443877774}},
      {{-1.5, 50.0}, 1.0, {.831908925061, .831908922371}},
      {{-1.5, 50.0}, 5.0, {.829236591719, .829235783625}},
      {{-1.5, 50.0}, 9.0, {.828410787463, .828410530393}},
  };
  for (const Case& expected : cases) {
    SCOPED_TRACE(testing::Message() << "k3 " << expected.spring.cubic << ", k5 " << expected.spring.quintic
                                    << ", amplitude " << expected.amplitude_deg << " deg");
    const Cycle cycle = limit_cycle(expected.spring, 7, expected.amplitude_deg);
    EXPECT_NEAR(cycle.velocity, expected.cycle.velocity, 1e-10);
    EXPECT_NEAR(cycle.frequency, expected.cycle.frequency, 1e-10);
  }
}

TEST(QuasiSteadyLco, OneHarmonicUnderpredictsTwoOverpredictThreeAreRight) {
  const std::vector<std::pair<int, double>> expected = {
      {1, .843519383818}, {2, .843590131691}, {3, .843558768733}, {5, .843558758490}};
  for (const auto& [harmonics, velocity] : expected)
    EXPECT_NEAR(limit_cycle({1.5, 0.0}, harmonics, 9.0).velocity, velocity, 1e-11)
        << harmonics << " harmonics";
}

TEST(QuasiSteadyLco, SpeedGradientMatchesTheReference) {
  const std::vector<std::pair<int, Eigen::Vector2d>> expected = {{2, {0.0414618981, 0.0023792272}},
                                                                 {5, {0.0414618254, 0.0023811824}}};
  for (const auto& [harmonics, gradient] : expected) {
    LimitCycle problem(section({-1.5, 50.0}), harmonics, 5.0 * degree);
    const Eigen::Vector2d computed = problem.velocity_gradient(solve(problem, 5.0 * degree));
    EXPECT_NEAR(computed[0], gradient[0], 1e-10) << harmonics << " harmonics";
    EXPECT_NEAR(computed[1], gradient[1], 1e-10) << harmonics << " harmonics";
  }
}

}  // namespace
}  // namespace wingbeat
