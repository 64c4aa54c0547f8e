#include "optimize/ipopt_adapter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/io/error.hpp"
#include "test/optimize/toy_programs.hpp"

namespace wingbeat {
namespace {

// Largest entry of grad f + y^T grad g - z_lower + z_upper.
double dual_infeasibility(const ToyProgram& program, const OptimizerResult& result) {
  const auto gradients = program.give_gradients(result.x).value();
  const std::size_t n = result.x.size();
  double largest = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    double entry = gradients.objective[j] - result.lower_multipliers[j] + result.upper_multipliers[j];
    for (std::size_t i = 0; i < result.constraint_multipliers.size(); ++i)
      entry += result.constraint_multipliers[i] * gradients.constraints[i * n + j];
    largest = std::max(largest, std::abs(entry));
  }
  return largest;
}

void expect_once_each(const std::map<std::vector<double>, int>& calls) {
  EXPECT_FALSE(calls.empty());
  for (const auto& [point, count] : calls) EXPECT_EQ(count, 1) << "first coordinate " << point[0];
}

TEST(Ipopt, FindsTheKnownMinimumOfProblem71) {
  constexpr double tolerance = 1e-8;
  ToyProgram program = hock_schittkowski_71();
  const OptimizerResult result = minimize(program, {.tolerance = tolerance});
  EXPECT_EQ(result.status, OptimizerStatus::converged) << result.message;
  // Nine pairs of complementarity, two violations times multipliers below one, and the digits of f*.
  EXPECT_NEAR(result.objective, 17.0140173, 11 * tolerance + 5e-8);
  EXPECT_LE(result.kkt_error, tolerance);
  EXPECT_EQ(result.objective, program.give_values(result.x)->objective);
  EXPECT_EQ(result.constraints, program.give_values(result.x)->constraints);
  EXPECT_EQ(result.iterations, program.iterations.back().iteration);
}

TEST(Ipopt, MultipliersBalanceTheGradientsToTheToleranceHoweverLargeTheyAre) {
  for (const double factor : {1.0, 1e4}) {
    ToyProgram program = hock_schittkowski_71(factor);
    const OptimizerResult result = minimize(program);
    ASSERT_EQ(result.status, OptimizerStatus::converged) << result.message;
    // Ipopt sums the same terms in another order: round-off of the largest.
    EXPECT_LE(dual_infeasibility(program, result), IpoptOptions{}.tolerance + 1e-14 * factor * 20.0);
    EXPECT_GE(*std::ranges::min_element(result.lower_multipliers), 0.0);
    EXPECT_GT(result.lower_multipliers[0], factor) << "x_0 rests on its lower bound";
  }
}

TEST(Ipopt, StopsAtABoundOfRosenbrocksValley) {
  constexpr double tolerance = 1e-8, limit = 0.5;
  ToyProgram program = rosenbrock(limit);
  const OptimizerResult result = minimize(program, {.tolerance = tolerance});
  EXPECT_EQ(result.status, OptimizerStatus::converged) << result.message;
  // The multiplier of the bound is 1: its distance is the tolerance at most; x_1 follows with slope 2 x_0 and
  // an error of the gradient over 200.
  EXPECT_NEAR(result.x[0], limit, 2 * tolerance);
  EXPECT_NEAR(result.x[1], limit * limit, 4 * tolerance);
  for (const auto& x : program.asked) EXPECT_LE(x[0], limit) << "bounds hold at every point";
}

TEST(Ipopt, FixedVariablesKeepTheirValues) {
  ToyProgram program = hock_schittkowski_71();
  program.limits.x_upper[0] = 1.0;  // where the minimum has it
  const OptimizerResult result = minimize(program, {.tolerance = 1e-8});
  EXPECT_EQ(result.status, OptimizerStatus::converged) << result.message;
  EXPECT_NEAR(result.objective, 17.0140173, 2e-7);
  EXPECT_EQ(result.x.size(), 4U);
  for (const auto& x : program.asked) EXPECT_EQ(x[0], 1.0);
}

TEST(Ipopt, EveryVariableMayBeFixed) {
  ToyProgram program = rosenbrock(0.5);
  program.limits.x_lower = program.limits.x_upper = program.first = {0.25, 0.5};
  const OptimizerResult result = minimize(program);
  EXPECT_EQ(result.status, OptimizerStatus::converged) << result.message;
  EXPECT_EQ(result.x, program.first);
  EXPECT_EQ(result.objective, program.give_values(result.x)->objective);
}

TEST(Ipopt, StepsOverTheEdgeOfWhatCanBeEvaluatedAreShortened) {
  constexpr double weight = 0.01;
  ToyProgram program = half_line(weight);
  const OptimizerResult result = minimize(program);
  EXPECT_EQ(result.status, OptimizerStatus::converged) << result.message;
  EXPECT_GE(program.failures, 1) << "the test never reached the edge";
  // The second derivative at the minimum is 1 / weight; within the distance it varies by a few per cent.
  EXPECT_NEAR(result.x[0], weight, 1.1 * weight * IpoptOptions{}.tolerance);
  EXPECT_EQ(result.objective, program.give_values(result.x)->objective);
}

TEST(Ipopt, NumbersThatAreNotFiniteCountAsNone) {
  ToyProgram by_none = half_line(0.01), by_nan = half_line(0.01);
  by_nan.give_values = [=, inner = by_none.give_values](std::span<const double> x) {
    return inner(x).value_or(ProgramValues{std::nan(""), {}});
  };
  EXPECT_EQ(minimize(by_nan).x, minimize(by_none).x);
}

TEST(Ipopt, EachPointIsEvaluatedOnce) {
  for (ToyProgram program :
       {hock_schittkowski_71(), rosenbrock(0.9), half_line(0.01), circle_out_of_reach()}) {
    minimize(program);
    expect_once_each(program.value_calls);
    expect_once_each(program.gradient_calls);
  }
}

TEST(Ipopt, GradientsAreAskedForWhereValuesJustWere) {
  ToyProgram program = half_line(0.01);
  program.give_gradients = [&, inner = program.give_gradients](std::span<const double> x) {
    EXPECT_EQ(program.asked.back()[0], x[0]);
    return inner(x);
  };
  minimize(program);
}

TEST(Ipopt, EqualProgrammesAreAskedForBitIdenticalPoints) {
  ToyProgram one = hock_schittkowski_71(), other = hock_schittkowski_71();
  const OptimizerResult first = minimize(one), second = minimize(other);
  EXPECT_EQ(one.asked, other.asked);
  EXPECT_EQ(first.x, second.x);
  EXPECT_EQ(first.constraint_multipliers, second.constraint_multipliers);
}

TEST(Ipopt, IterationsTellWhereTheOptimisationStands) {
  ToyProgram program = hock_schittkowski_71();
  const OptimizerResult result = minimize(program);
  ASSERT_EQ(program.iterations.size(), static_cast<std::size_t>(result.iterations) + 1U);
  const ProgramIteration& last = program.iterations.back();
  EXPECT_EQ(program.iterations.front().iteration, 0);
  EXPECT_EQ(program.iterations.front().step, 0.0);
  EXPECT_EQ(last.objective, result.objective);
  EXPECT_EQ(last.kkt_error, result.kkt_error);
  const double violation =
      std::max({25.0 - result.constraints[0], std::abs(result.constraints[1] - 40.0), 0.0});
  EXPECT_DOUBLE_EQ(last.infeasibility, violation);
  EXPECT_GT(last.step, 0.0);
  EXPECT_GE(last.trials, 1);
  EXPECT_LT(last.barrier, program.iterations.front().barrier);
  EXPECT_FALSE(last.is_restoring);
}

TEST(Ipopt, TheStepIsTheLargestChangeOfAVariable) {
  ToyProgram program = rosenbrock(0.5);
  std::vector<std::vector<double>> iterates;
  program.judge = [&](const ProgramIteration&) {
    iterates.push_back(program.asked.back());
    return true;
  };
  minimize(program);
  ASSERT_GE(iterates.size(), 3U);
  for (std::size_t k = 1; k < iterates.size(); ++k) {
    const double change = std::max(std::abs(iterates[k][0] - iterates[k - 1][0]),
                                   std::abs(iterates[k][1] - iterates[k - 1][1]));
    EXPECT_DOUBLE_EQ(program.iterations[k].step, change) << "iteration " << k;
  }
}

TEST(Ipopt, RefusesAProgrammeThatContradictsItself) {
  ToyProgram crossed = rosenbrock(0.5);
  crossed.limits.x_upper[0] = -2.0;
  EXPECT_THROW(minimize(crossed), InternalError);
  ToyProgram short_of_one = hock_schittkowski_71();
  short_of_one.give_values = [](std::span<const double>) { return ProgramValues{0.0, {1.0}}; };
  EXPECT_THROW(minimize(short_of_one), InternalError);
}

}  // namespace
}  // namespace wingbeat
