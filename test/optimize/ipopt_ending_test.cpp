#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <stdexcept>

#include "core/io/error.hpp"
#include "test/optimize/toy_programs.hpp"

// How an optimisation ends other than at a minimum.
namespace wingbeat {
namespace {

class Interruption : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

void expect_interruption(ToyProgram& program) {
  try {
    minimize(program);
    FAIL() << "nothing was thrown";
  } catch (const Interruption& interruption) {
    EXPECT_STREQ(interruption.what(), "by the user");
  }
}

TEST(IpoptEnding, InfeasibleConstraintsAreReportedAsSuch) {
  ToyProgram program = circle_out_of_reach();
  const OptimizerResult result = minimize(program);
  EXPECT_EQ(result.status, OptimizerStatus::infeasible) << result.message;
  // The corner violates least; the restoration minimises the violation with a small weight on distance.
  EXPECT_NEAR(result.x[0], 1.0, 1e-3);
  EXPECT_NEAR(result.x[1], 1.0, 1e-3);
  const auto is_restoring = [](const ProgramIteration& iteration) { return iteration.is_restoring; };
  const auto restoration = std::ranges::find_if(program.iterations, is_restoring);
  ASSERT_NE(restoration, program.iterations.end());
  EXPECT_NEAR(program.iterations.back().infeasibility, 2.0, 1e-2);
}

TEST(IpoptEnding, AStartThatCannotBeEvaluatedEndsWithoutNumbers) {
  ToyProgram program = half_line(0.01);
  program.first = {-1.0};
  const OptimizerResult result = minimize(program);
  EXPECT_EQ(result.status, OptimizerStatus::evaluation_failed);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.x, program.first);
  EXPECT_TRUE(std::isnan(result.objective));
  EXPECT_TRUE(result.constraints.empty());
  EXPECT_TRUE(result.constraint_multipliers.empty());
  EXPECT_TRUE(std::isnan(result.kkt_error));
  EXPECT_EQ(program.failures, 1);
}

TEST(IpoptEnding, MissingGradientsKeepTheValuesOfTheirPoint) {
  ToyProgram program = half_line(0.01);
  program.give_gradients = [&, inner = program.give_gradients](std::span<const double> x) {
    return x[0] < 2.0 ? std::nullopt : inner(x);
  };
  const OptimizerResult result = minimize(program);
  EXPECT_EQ(result.status, OptimizerStatus::evaluation_failed);
  EXPECT_LT(result.x[0], 2.0);
  EXPECT_EQ(result.objective, program.give_values(result.x)->objective);
  EXPECT_EQ(program.failures, 1);
}

TEST(IpoptEnding, NoPointBesideTheStartEndsAsFailedEvaluation) {
  ToyProgram program = half_line(0.01);
  program.give_values = [&, inner = program.give_values](std::span<const double> x) {
    return x[0] < 2.0 ? std::nullopt : inner(x);
  };
  const OptimizerResult result = minimize(program);
  EXPECT_EQ(result.status, OptimizerStatus::evaluation_failed) << result.message;
  EXPECT_EQ(result.x, program.first);
  EXPECT_EQ(result.objective, program.give_values(result.x)->objective);
  EXPECT_EQ(program.failures, 20);
}

TEST(IpoptEnding, ExceptionsOfTheProgrammeReachTheCaller) {
  ToyProgram in_values = hock_schittkowski_71(), in_gradients = hock_schittkowski_71(),
             in_observe = hock_schittkowski_71();
  in_values.give_values = [&, inner = in_values.give_values](std::span<const double> x) {
    if (in_values.asked.size() == 3U) throw Interruption("by the user");
    return inner(x);
  };
  in_gradients.give_gradients = [&, inner = in_gradients.give_gradients](std::span<const double> x) {
    if (in_gradients.gradient_calls.size() == 3U) throw Interruption("by the user");
    return inner(x);
  };
  in_observe.judge = [](const ProgramIteration& state) {
    if (state.iteration == 2) throw Interruption("by the user");
    return true;
  };
  for (ToyProgram* program : {&in_values, &in_gradients, &in_observe}) expect_interruption(*program);
  EXPECT_EQ(in_values.asked.size(), 3U) << "nothing is evaluated after the exception";
}

// Of this one Ipopt itself makes a status.
TEST(IpoptEnding, LackOfMemoryReachesTheCaller) {
  ToyProgram program = hock_schittkowski_71();
  program.give_gradients = [](std::span<const double>) -> std::optional<ProgramGradients> {
    throw std::bad_alloc();
  };
  EXPECT_THROW(minimize(program), std::bad_alloc);
}

TEST(IpoptEnding, ObserveStopsTheOptimisation) {
  ToyProgram program = hock_schittkowski_71();
  program.judge = [](const ProgramIteration& state) { return state.iteration < 2; };
  const OptimizerResult result = minimize(program);
  EXPECT_EQ(result.status, OptimizerStatus::stopped);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_EQ(result.objective, program.iterations.back().objective);
}

TEST(IpoptEnding, ObserveStopsARestoration) {
  ToyProgram program = circle_out_of_reach();
  program.judge = [](const ProgramIteration& state) { return !state.is_restoring; };
  const OptimizerResult result = minimize(program);
  EXPECT_EQ(result.status, OptimizerStatus::stopped) << result.message;
  EXPECT_EQ(result.objective, program.give_values(result.x)->objective);
}

TEST(IpoptEnding, TheLimitOfIterationsIsKept) {
  ToyProgram program = hock_schittkowski_71();
  const OptimizerResult result = minimize(program, {.max_iterations = 3});
  EXPECT_EQ(result.status, OptimizerStatus::iteration_limit);
  EXPECT_EQ(result.iterations, 3);
  EXPECT_NE(result.message.find('3'), std::string::npos);
}

TEST(IpoptEnding, AnUnboundedObjectiveStalls) {
  ToyProgram program = half_line(0.0);
  program.give_values = [](std::span<const double> x) { return ProgramValues{x[0], {}}; };
  program.give_gradients = [](std::span<const double>) { return ProgramGradients{{1.0}, {}}; };
  const IpoptOptions options{.extra = {"diverging_iterates_tol = 20"}};
  EXPECT_EQ(minimize(program, options).status, OptimizerStatus::stalled);
}

TEST(IpoptEnding, GradientsThatPointUphillStall) {
  ToyProgram program = rosenbrock(0.5);
  program.give_gradients = [inner = program.give_gradients](std::span<const double> x) {
    auto gradients = inner(x);
    for (double& derivative : gradients->objective) derivative = -derivative;
    return gradients;
  };
  const OptimizerResult result = minimize(program);
  EXPECT_EQ(result.status, OptimizerStatus::stalled) << result.message;
  EXPECT_EQ(result.objective, program.give_values(result.x)->objective);
  EXPECT_EQ(result.kkt_error, program.iterations.back().kkt_error);
  EXPECT_EQ(program.asked.size(), 21U) << "the start and one iteration's trials";
}

TEST(IpoptEnding, MoreEqualitiesThanVariablesAreTheCasesFault) {
  ToyProgram program = circle_out_of_reach();
  program.limits.g_lower = program.limits.g_upper = {1.0, 1.0, 1.0};
  program.give_values = [](std::span<const double> x) {
    return ProgramValues{x[0], {x[0], x[1], x[0] + x[1]}};
  };
  program.give_gradients = [](std::span<const double>) {
    return ProgramGradients{{1.0, 0.0}, {1.0, 0.0, 0.0, 1.0, 1.0, 1.0}};
  };
  EXPECT_THROW(minimize(program), InputError);
}

TEST(IpoptEnding, EveryStatusHasAName) {
  EXPECT_EQ(to_string(OptimizerStatus::converged), "converged");
  EXPECT_EQ(to_string(OptimizerStatus::evaluation_failed), "evaluation failed");
}

}  // namespace
}  // namespace wingbeat
