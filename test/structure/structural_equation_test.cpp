#include "structure/structural_equation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "structure/harmonic_motion.hpp"

namespace wingbeat {
namespace {

using Values = std::vector<double>;

// Three coupled, damped modes, two with nonlinear springs.
StructureModel three_modes() {
  StructureModel model;
  model.modes = {"first", "second", "third"};
  model.mass.resize(3, 3);
  model.mass << 1.0, 0.2, 0.1, 0.2, 0.7, -0.1, 0.1, -0.1, 0.5;
  model.stiffness.resize(3, 3);
  model.stiffness << 0.3, 0.05, 0.0, 0.05, 1.0, 0.1, 0.0, 0.1, 2.0;
  model.damping.resize(3, 3);
  model.damping << 0.02, 0.01, 0.0, -0.01, 0.03, 0.0, 0.0, 0.0, 0.05;
  model.load_factor = 0.04;
  model.phase_mode = 1;
  model.restoring = {polynomial_spring(0, 0.7, -0.2), polynomial_spring(2, -1.5, 5.0)};
  return model;
}

Values arbitrary(std::size_t size, double seed) {
  Values v(size);
  for (std::size_t i = 0; i < size; ++i) v[i] = std::sin(seed + 1.7 * static_cast<double>(i));
  return v;
}

double dot(const Values& a, const Values& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

class StructuralEquationTest : public ::testing::Test {
 protected:
  const StructuralEquation equation{three_modes(), TimeSpectral(2)};
  const Values y = arbitrary(equation.state_size(), 0.3);
  const Values f = arbitrary(equation.force_size(), 0.9);
  const double omega = 0.8;
  const double load = 0.37;

  Values residual(const Values& state, double frequency, double factor, const Values& force) const {
    Values s(equation.state_size());
    equation.residual(state, frequency, factor, force, s);
    return s;
  }
};

// A free vibration of the linear part, u = phi cos(omega t), balances at its own frequency.
TEST_F(StructuralEquationTest, VanishesOnFreeVibration) {
  StructureModel model = three_modes();
  model.damping.setZero();
  model.restoring.clear();
  const StructuralEquation linear(model, TimeSpectral(2));
  const VacuumModes modes = vacuum_modes(model);
  for (int j = 0; j < 3; ++j) {
    const Values state = harmonic_states(
        model, linear.time(), modes.shapes.col(j).cast<std::complex<double>>(), modes.frequencies[j]);
    Values s(linear.state_size());
    linear.residual(state, modes.frequencies[j], load, Values(linear.force_size(), 0.0), s);
    for (const double value : s) EXPECT_NEAR(value, 0.0, 1e-14);
  }
}

// A static load is carried by the springs, linear and not.
TEST_F(StructuralEquationTest, OneInstanceIsStaticEquilibrium) {
  const StructureModel model = three_modes();
  const StructuralEquation at_rest(model, TimeSpectral(0));
  const Eigen::Vector3d u(0.2, -0.1, 0.3);
  Eigen::Vector3d reaction = model.stiffness * u;
  for (const RestoringForce& spring : model.restoring) reaction[spring.mode] += spring.value(u[spring.mode]);
  const Eigen::Vector3d force = reaction / load;
  const Values state = {u[0], u[1], u[2], 0.0, 0.0, 0.0};
  Values s(6);
  at_rest.residual(state, omega, load, Values(force.data(), force.data() + 3), s);
  for (const double value : s) EXPECT_NEAR(value, 0.0, 1e-15);
}

TEST_F(StructuralEquationTest, DerivativesMatchDifferencesOfTheResidual) {
  const Values dy = arbitrary(y.size(), 2.0), df = arbitrary(f.size(), 3.0);
  const double domega = 0.6, dload = -0.4, h = 1e-5;
  const auto moved = [&](double step) {
    Values state = y, force = f;
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += step * dy[i];
    for (std::size_t i = 0; i < force.size(); ++i) force[i] += step * df[i];
    return residual(state, omega + step * domega, load + step * dload, force);
  };
  Values tangent(y.size(), 0.0), by_omega(y.size()), by_load(y.size());
  equation.add_state_tangent(y, omega, dy, 1.0, tangent);
  equation.add_force_tangent(load, df, 1.0, tangent);
  equation.frequency_derivative(y, by_omega);
  equation.load_derivative(f, by_load);
  const Values above = moved(h), below = moved(-h);
  // Central difference of a quintic with O(10) third derivative: h^2 and round-off/h are both 1e-9 or less.
  for (std::size_t i = 0; i < y.size(); ++i)
    EXPECT_NEAR(tangent[i] + domega * by_omega[i] + dload * by_load[i], (above[i] - below[i]) / (2.0 * h),
                2e-8);
}

TEST_F(StructuralEquationTest, DenseJacobianIsTheTangent) {
  const Values dy = arbitrary(y.size(), 2.0);
  Values tangent(y.size(), 0.0);
  equation.add_state_tangent(y, omega, dy, 1.0, tangent);
  const auto n = static_cast<Eigen::Index>(y.size());
  const Eigen::VectorXd product =
      equation.state_jacobian(y, omega) * Eigen::Map<const Eigen::VectorXd>(dy.data(), n);
  EXPECT_LT((product - Eigen::Map<const Eigen::VectorXd>(tangent.data(), n)).norm(), 1e-13);
}

TEST_F(StructuralEquationTest, AdjointsAreTheTransposes) {
  const Values lambda = arbitrary(y.size(), 4.0);
  const Values dy = arbitrary(y.size(), 2.0), df = arbitrary(f.size(), 3.0);
  Values tangent(y.size(), 0.0), adjoint(y.size(), 0.0);
  equation.add_state_tangent(y, omega, dy, 0.7, tangent);
  equation.add_state_adjoint(y, omega, lambda, 0.7, adjoint);
  EXPECT_NEAR(dot(lambda, tangent), dot(adjoint, dy),
              1e-12 * std::sqrt(dot(tangent, tangent) * dot(lambda, lambda)));

  Values force_tangent(y.size(), 0.0), force_adjoint(f.size(), 0.0);
  equation.add_force_tangent(load, df, -1.3, force_tangent);
  equation.add_force_adjoint(load, lambda, -1.3, force_adjoint);
  EXPECT_NEAR(dot(lambda, force_tangent), dot(force_adjoint, df), 1e-12);
  EXPECT_GT(std::abs(dot(lambda, force_tangent)), 1e-3);
}

}  // namespace
}  // namespace wingbeat
