// Gradients of every objective: adjoint against tangent and differences, on any number of ranks.
#include <gtest/gtest.h>

#include "test/adjoint/analysis_cases.hpp"

namespace wingbeat::testing {
namespace {

MultiblockMesh<2> small_mesh(int blocks = 1) { return section_mesh("naca64a010", 64, 16, blocks); }

// Adjoint and tangent solve the same equations to 1e-12; what is lost is the conditioning of the sums.
void expect_adjoint_is_tangent(const Analysis<2>& analysis, const ShapeVariables& shape, const std::string& name) {
  const Functional<2>& functional = analysis.functional();
  const Parameters<2> gradient = adjoint_gradient(analysis);
  for (const auto& [shape_size, scalar_size] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}) {
    const Parameters<2> change = direction(shape, shape_size, scalar_size);
    const DirectionalDerivative tangent = directional_derivative(functional, analysis.point(), change, tight());
    EXPECT_LT(tangent.solve.relative_residual, 1e-12);
    EXPECT_NEAR(parameter_dot(functional.comm(), gradient, change), tangent.value, 1e-9 * std::abs(tangent.value))
        << name << ", directions " << shape_size << ", " << scalar_size;
  }
}

// Central differences at steps h and h/2, extrapolated: what is left is of fourth order.
double difference(Analysis<2>& analysis, const ShapeVariables& shape, double shape_size, double scalar_size,
                  double h) {
  const auto value = [&](double step) {
    analysis.solve(direction(shape, step * shape_size, step * scalar_size));
    return analysis.functional().value();
  };
  const auto central = [&](double step) { return (value(step) - value(-step)) / (2.0 * step); };
  return (4.0 * central(0.5 * h) - central(h)) / 3.0;
}

void expect_gradient_is_difference(Analysis<2>& analysis, const ShapeVariables& shape, double tolerance,
                                   const std::string& name) {
  analysis.solve(no_change<2>(shape.nodes()));
  const Parameters<2> gradient = adjoint_gradient(analysis);
  for (const auto& [shape_size, scalar_size, h] : {std::tuple{1.0, 0.0, 2e-4}, {0.0, 1.0, 2e-4}}) {
    const double expected = difference(analysis, shape, shape_size, scalar_size, h);
    const double found = parameter_dot(Comm(), gradient, direction(shape, shape_size, scalar_size));
    EXPECT_NEAR(found, expected, tolerance * std::abs(expected))
        << name << ", directions " << shape_size << ", " << scalar_size;
  }
}

ForcedMotion resting_at(double pitch) {
  ForcedMotion motion;
  motion.mean_pitch = pitch;
  return motion;
}

ForcedMotion pitching() {
  ForcedMotion motion;
  motion.mean_pitch = 0.01;
  motion.pitch = {{0.0, -0.02}};
  motion.plunge = {{0.01, 0.005}};
  return motion;
}

TEST(Gradient, AdjointIsTangentForNumbersOfAFlutterPoint) {
  const CycleCase c(small_mesh(), 1, 1e-6);
  for (const auto& [quantity, name] :
       {std::pair{CycleQuantity::speed, "speed"}, {CycleQuantity::frequency, "frequency"}}) {
    CycleAnalysis<2> analysis = c.analysis({.quantity = quantity, .energy = 1e-6});
    analysis.solve(no_change<2>(c.shape.nodes()));
    expect_adjoint_is_tangent(analysis, c.shape, name);
  }
}

TEST(Gradient, AdjointIsTangentForACycleOfGivenSpeed) {
  const double energy = 5e-4;
  const CycleCase c(small_mesh(), 2, energy);
  const double speed = std::sqrt(c.flutter.state.r);
  for (const auto& [quantity, name] :
       {std::pair{CycleQuantity::energy, "energy"}, {CycleQuantity::amplitude, "amplitude"}}) {
    CycleAnalysis<2> analysis =
        c.analysis({.quantity = quantity, .energy = energy, .reduced_velocity = speed});
    analysis.solve(no_change<2>(c.shape.nodes()));
    expect_adjoint_is_tangent(analysis, c.shape, name);
  }
}

TEST(Gradient, AdjointIsTangentForSteadyLoads) {
  const LoadCase c(small_mesh(), 0.8, 0);
  const Vec<double, 2> reference{{{0.3, 0.02}}};
  for (const auto& [coefficient, name] : {std::pair{LoadCoefficient::drag, "drag"},
                                          {LoadCoefficient::lift, "lift"},
                                          {LoadCoefficient::moment, "moment"}}) {
    FlowAnalysis<2> analysis = c.analysis({coefficient}, resting_at(0.01), 0.0, reference);
    analysis.solve(no_change<2>(c.shape.nodes()));
    expect_adjoint_is_tangent(analysis, c.shape, name);
  }
}

TEST(Gradient, AdjointIsTangentForHarmonicsOfForcedMotion) {
  const LoadCase c(small_mesh(), 0.75, 1);
  FlowAnalysis<2> analysis = c.analysis({LoadCoefficient::lift, 0, false}, pitching(), 0.2);
  analysis.solve(no_change<2>(c.shape.nodes()));
  for (const LoadQuantity quantity : {LoadQuantity{LoadCoefficient::drag, 0, false},
                                      {LoadCoefficient::lift, 1, false},
                                      {LoadCoefficient::lift, 1, true},
                                      {LoadCoefficient::moment, 1, true}}) {
    analysis.choose({{1.0, quantity}});
    expect_adjoint_is_tangent(analysis, c.shape, "harmonic " + std::to_string(quantity.harmonic));
  }
}

TEST(Gradient, AgreesWithDifferences) {
  {
    const LoadCase c(small_mesh(), 0.8, 0);
    FlowAnalysis<2> drag = c.analysis({LoadCoefficient::drag}, resting_at(0.01));
    expect_gradient_is_difference(drag, c.shape, 1e-6, "drag");
  }
  {
    const LoadCase c(small_mesh(), 0.75, 1);
    FlowAnalysis<2> lift = c.analysis({LoadCoefficient::lift, 1, true}, pitching(), 0.2);
    expect_gradient_is_difference(lift, c.shape, 1e-6, "lift");
  }
  const double energy = 1e-4;
  const CycleCase c(small_mesh(), 1, energy);
  CycleAnalysis<2> speed = c.analysis({.energy = energy});
  expect_gradient_is_difference(speed, c.shape, 1e-6, "speed");
  CycleAnalysis<2> amplitude = c.analysis({.quantity = CycleQuantity::amplitude,
                                           .energy = energy,
                                           .reduced_velocity = std::sqrt(c.flutter.state.r)});
  expect_gradient_is_difference(amplitude, c.shape, 2e-5, "amplitude");
}

}  // namespace
}  // namespace wingbeat::testing
