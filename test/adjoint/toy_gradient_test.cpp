// The exactly known limit cycle of the quasi-steady section: its gradient through the adjoint code.
#include <gtest/gtest.h>

#include "adjoint/adjoint.hpp"
#include "adjoint/section_derivatives.hpp"
#include "structure/energy.hpp"
#include "test/verification/quasi_steady_cycle.hpp"

namespace wingbeat {
namespace {

using namespace quasi_steady;

// dV/d(mass ratio, k3) at a pitch amplitude of 5 degrees, k3 = -1.5, k5 = 50: to ten digits from an
// independent program (He, Jonsson & Martins, Nonlinear Dynamics 2022, its example).
TEST(ToyGradient, MatchesTheReference) {
  for (const auto& [harmonics, expected] : {std::pair{2, Eigen::Vector2d(0.0414618981, 0.0023792272)},
                                            {5, Eigen::Vector2d(0.0414618254, 0.0023811824)}}) {
    const double amplitude = 5.0 * degree;
    const StructureModel model = section({-1.5, 50.0});
    LimitCycle problem(model, harmonics, amplitude);
    std::vector<double> u = problem.start(hopf_point(), amplitude);
    NewtonOptions newton_options;
    newton_options.forcing_max = 1e-3;
    newton_options.refactor_iterations = 4;
    ASSERT_EQ(newton(Comm(), problem, u, newton_options).status, SolveStatus::converged);
    problem.linearize(u);
    problem.refactor();

    std::vector<double> by_state(u.size(), 0.0);
    by_state.back() = 1.0;  // V
    const AdjointSolution adjoint = solve_adjoint(Comm(), problem, by_state, {.relative_tolerance = 1e-13});
    EXPECT_EQ(adjoint.solve.status, GmresStatus::converged);

    const StructuralEquation structure(model, TimeSpectral(harmonics));
    const std::size_t states = structure.state_size();
    const std::span<const double> y = std::span<const double>(u).first(states);
    const double velocity = u.back();
    std::vector<double> f;
    for (std::size_t i = 0; i < states; i += 4)
      for (int j = 0; j < 2; ++j) f.push_back(force_direction[j] * (y[i + 1] + y[i + 2] / velocity));
    ModelChange by_mass, by_cubic;
    for (ModelChange* change : {&by_mass, &by_cubic})
      change->mass = change->damping = change->stiffness = Eigen::Matrix2d::Zero();
    by_mass.load_factor = -2.0 / (mass_ratio * mass_ratio);
    by_cubic.restoring = {polynomial_spring(quasi_steady::pitch_mode, gyration_radius_squared, 0.0)};
    const auto derivative = [&](const ModelChange& change) {
      const std::vector<double> rows = structure_tangent(structure, y, velocity, f, change);
      double sum = 0.0;
      for (std::size_t i = 0; i < rows.size(); ++i) sum += adjoint.multipliers[i] * rows[i];
      return sum;
    };
    EXPECT_NEAR(derivative(by_mass), expected[0], 1e-8) << harmonics << " harmonics";
    EXPECT_NEAR(derivative(by_cubic), expected[1], 1e-8) << harmonics << " harmonics";
  }
}

// Central differences of a smooth function, h = 1e-5: h^2 f'''/6 and eps/h leave some 1e-9.
TEST(SectionDerivatives, AgreeWithDifferencesWithDampingAndFreeplay) {
  TypicalSection base{-0.6, 0.25, 0.75, 0.5, 75.0, {0.02, 0.05}};
  base.pitch_spring = {3.0, -20.0, 0.01};
  base.plunge_spring = {1.5, 0.0, 0.02};
  const TimeSpectral time(2);
  std::vector<double> y, f;
  for (int i = 0; i < 20; ++i) y.push_back(0.05 * std::sin(1.0 + 1.7 * i));
  for (int i = 0; i < 10; ++i) f.push_back(0.3 * std::cos(2.0 * i));
  const double velocity = 2.7, omega = 0.6, h = 1e-5;
  const auto residual = [&](const TypicalSection& section) {
    const StructuralEquation structure(structure_model(section), time);
    std::vector<double> s(y.size());
    structure.residual(y, omega, structure.model().load(velocity), f, s);
    return s;
  };
  for (std::size_t k = 0; k < section_scalar_count; ++k) {
    TypicalSection above = base, below = base;
    const auto value_of = [k](TypicalSection& section) -> double& {
      return *std::array{&section.static_unbalance, &section.gyration_radius_squared,
                         &section.frequency_ratio, &section.mass_ratio}[k];
    };
    value_of(above) += h;
    value_of(below) -= h;
    const ModelChange change = section_derivative(base, k);
    const StructuralEquation structure(structure_model(base), time);
    const std::vector<double> tangent = structure_tangent(structure, y, velocity, f, change);
    const std::vector<double> plus = residual(above), minus = residual(below);
    for (std::size_t i = 0; i < y.size(); ++i)
      EXPECT_NEAR(tangent[i], (plus[i] - minus[i]) / (2.0 * h), 1e-8)
          << scalar_names[first_section_scalar + k] << ", row " << i;
    EXPECT_NEAR(
        fluctuating_energy_change(change, y),
        (fluctuating_energy(structure_model(above), y) - fluctuating_energy(structure_model(below), y)) /
            (2.0 * h),
        1e-10);
  }
}

}  // namespace
}  // namespace wingbeat
