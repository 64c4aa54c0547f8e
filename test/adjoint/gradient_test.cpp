// Gradients of every objective: adjoint against tangent and differences, on any number of ranks.
#include <gtest/gtest.h>

#include "adjoint/design_variables.hpp"
#include "adjoint/gradient_settings.hpp"
#include "test/adjoint/analysis_cases.hpp"

namespace wingbeat::testing {
namespace {

MultiblockMesh<2> small_mesh(int blocks = 1) { return section_mesh("naca64a010", 64, 16, blocks); }

// Adjoint and tangent solve the same equations to 1e-12; what is lost is the conditioning of the sums.
void expect_adjoint_is_tangent(const Analysis<2>& analysis, const ShapeVariables& shape,
                               const std::string& name) {
  const Functional<2>& functional = analysis.functional();
  const Parameters<2> gradient = adjoint_gradient(analysis);
  for (const auto& [shape_size, scalar_size] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}) {
    const Parameters<2> change = direction(shape, shape_size, scalar_size);
    const DirectionalDerivative tangent =
        directional_derivative(functional, analysis.point(), change, tight());
    EXPECT_LT(tangent.solve.relative_residual, 1e-12);
    EXPECT_NEAR(parameter_dot(functional.comm(), gradient, change), tangent.value,
                1e-9 * std::abs(tangent.value))
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

std::vector<double> by_variables(const GradientSettings& settings, const ShapeVariables& shape,
                                 const Comm& ranks, const Parameters<2>& gradient) {
  return DesignVariables(settings.parameters, shape, 0.01)
      .derivatives(shape.wall_sensitivity(ranks, gradient.nodes), gradient);
}

// Bumps and single numbers: derivatives of a small flutter point and of steady drag, on some ranks.
std::vector<double> all_derivatives(const Comm& ranks, int blocks) {
  GradientSettings settings;
  settings.parameters = {"bumps", "mach", "angle_of_attack", "structure"};
  std::vector<double> all;
  {
    const CycleCase c(section_mesh("naca64a010", 48, 12, blocks), 1, 1e-4, ranks);
    CycleAnalysis<2> speed = c.analysis({.energy = 1e-4});
    speed.solve(no_change<2>(c.shape.nodes()));
    all = by_variables(settings, c.shape, ranks, adjoint_gradient(speed));
  }
  const LoadCase c(section_mesh("naca64a010", 48, 12, blocks), 0.8, 0, ranks);
  FlowAnalysis<2> drag = c.analysis({LoadCoefficient::drag}, resting_at(0.01));
  drag.solve(no_change<2>(c.shape.nodes()));
  const auto more = by_variables(settings, c.shape, ranks, adjoint_gradient(drag));
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(Gradient, IsTheSameOnAnyRanksAndBlocks) {
  const std::vector<double> alone = all_derivatives(Comm(MPI_COMM_SELF), 1);
  const std::vector<double> together = all_derivatives(Comm(), 3);
  ASSERT_EQ(alone.size(), together.size());
  double size = 0.0;
  for (double value : alone) size = std::max(size, std::abs(value));
  for (std::size_t i = 0; i < alone.size(); ++i)
    EXPECT_NEAR(together[i], alone[i], 1e-8 * std::max(std::abs(alone[i]), 1e-2 * size)) << "variable " << i;
}

// Mirrored bumps push the drag of a symmetric flow alike.
TEST(Gradient, OfDragIsSymmetricForASymmetricSection) {
  if (Comm().size() > 1) GTEST_SKIP() << "ranks are compared elsewhere";
  const LoadCase c(small_mesh(), 0.8, 0);
  FlowAnalysis<2> drag = c.analysis({LoadCoefficient::drag});
  drag.solve(no_change<2>(c.shape.nodes()));
  GradientSettings settings;
  const auto g = by_variables(settings, c.shape, Comm(), adjoint_gradient(drag));
  double size = 0.0;
  for (double value : g) size = std::max(size, std::abs(value));
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(g[i], g[23 - i], 1e-8 * size) << "bump " << i + 1;
}

// An odd number of instances does not hold theta + pi: mirrored bumps differ by aliasing, which falls with
// the energy and with the harmonics.
TEST(Gradient, OfFlutterIsSymmetricButForAliasing) {
  if (Comm().size() > 1) GTEST_SKIP() << "ranks are compared elsewhere";
  const auto asymmetry = [](int harmonics, double energy) {
    const CycleCase c(small_mesh(), harmonics, energy);
    CycleAnalysis<2> speed = c.analysis({.energy = energy});
    speed.solve(no_change<2>(c.shape.nodes()));
    const auto g = by_variables(GradientSettings{}, c.shape, Comm(), adjoint_gradient(speed));
    double size = 0.0, defect = 0.0;
    for (std::size_t i = 0; i < 12; ++i) {
      size = std::max(size, std::abs(g[i]));
      defect = std::max(defect, std::abs(g[i] - g[23 - i]));
    }
    return defect / size;
  };
  const double at_1e4 = asymmetry(1, 1e-4), at_1e6 = asymmetry(1, 1e-6), of_three = asymmetry(3, 1e-4);
  printf("  asymmetry: N_H = 1: %.1e at E_0 = 1e-4, %.1e at 1e-6; N_H = 3: %.1e at 1e-4\n", at_1e4, at_1e6,
         of_three);
  EXPECT_LT(at_1e6, 0.2 * at_1e4);
  EXPECT_LT(of_three, 0.2 * at_1e4);
}

// The lift held by the angle at changed shapes, by hand, against the stationary combination of drag and lift.
TEST(Gradient, OfDragAtFixedLiftIsThatOfTrimmedFlows) {
  if (Comm().size() > 1) GTEST_SKIP() << "ranks are compared elsewhere";
  const LoadCase c(small_mesh(), 0.75, 0);
  const LoadQuantity drag{LoadCoefficient::drag}, lift{LoadCoefficient::lift};
  FlowAnalysis<2> analysis = c.analysis(drag, resting_at(0.01));
  analysis.solve(no_change<2>(c.shape.nodes()));
  Parameters<2> turn = no_change<2>(c.shape.nodes());
  turn[Scalar::angle_of_attack] = 1.0;
  const auto along = [&](const LoadQuantity& quantity, const Parameters<2>& change) {
    analysis.choose({{1.0, quantity}});
    return directional_derivative(analysis.functional(), analysis.point(), change, tight()).value;
  };
  const double lift_slope = along(lift, turn), by_lift = along(drag, turn) / lift_slope;
  analysis.choose({{1.0, lift}});
  const double target = analysis.functional().value();
  analysis.choose({{1.0, drag}, {-by_lift, lift}});
  const double expected = parameter_dot(Comm(), adjoint_gradient(analysis), direction(c.shape, 1.0, 0.0));
  const auto trimmed_drag = [&](double step) {
    Parameters<2> change = direction(c.shape, step, 0.0);
    for (int i = 0; i < 6; ++i) {
      analysis.choose({{1.0, lift}});
      analysis.solve(change);
      change[Scalar::angle_of_attack] += (target - analysis.functional().value()) / lift_slope;
    }
    analysis.choose({{1.0, drag}});
    return analysis.functional().value();
  };
  const auto central = [&](double h) { return (trimmed_drag(h) - trimmed_drag(-h)) / (2.0 * h); };
  EXPECT_NEAR((4.0 * central(1e-4) - central(2e-4)) / 3.0, expected, 2e-6 * std::abs(expected));
}

TEST(Gradient, AgreesWithDifferences) {
  if (Comm().size() > 1) GTEST_SKIP() << "ranks are compared elsewhere";
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
