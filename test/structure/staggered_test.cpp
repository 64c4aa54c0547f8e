// The staggered iteration against the coupled Newton solution, with a flow solver that stands in for
// multigrid: inexact Newton steps, each of which leaves about a fifth of the residual.
#include "structure/staggered.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <tuple>

#include "structure/energy.hpp"
#include "test/structure/coupled_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;

constexpr int steps_allowed = 300;

// dR/dw at the last linearization of the flow.
class FlowOperator final : public LinearOperator<double> {
 public:
  explicit FlowOperator(const FlowEquations<2>& flow) : flow_(flow) {}
  std::size_t local_size() const override { return flow_.state_count(); }
  void apply(std::span<const double> x, std::span<double> y) const override { flow_.apply(x, y); }
  void apply_transpose(std::span<const double> x, std::span<double> y) const override {
    flow_.apply_transpose(x, y);
  }

 private:
  const FlowEquations<2>& flow_;
};

struct StaggeredCase {
  CoupledCase coupled;
  StructuralEquation structure;
  SectionKinematics kinematics;
  FlutterSolution reference;
  AeroelasticState start;
  HarmonicPreconditioner<2> preconditioner;
  StaggeredOptions options;

  explicit StaggeredCase(double energy, int harmonics = 1, int blocks = 1,
                         const Comm& ranks = Comm(MPI_COMM_SELF))
      : coupled(section_mesh("naca64a010", 64, 16, blocks, 60.0), 0.8, harmonics, ranks),
        structure(coupled.model, coupled.time),
        kinematics{coupled.flow_speed(), 0.0, 1.0},
        reference(solve_flutter(coupled, energy, {})),
        preconditioner(coupled.flow_case.domain, coupled.time,
                       unfactored(ranks, coupled.subdomain, state_size<2>, harmonics)) {
    coupled.flow.linearize(reference.state.w, motions(reference.state), kappa(reference.state));
    preconditioner.factor(coupled.flow, kappa(reference.state));
    options.flow_cycles = 1;
    options.max_iterations = steps_allowed;
    set_start(energy);
  }

  double kappa(const AeroelasticState& state) const { return kinematics.kappa(state.omega, state.r); }
  std::vector<MotionState> motions(const AeroelasticState& state) const {
    std::vector<MotionState> result;
    for (std::size_t n = 0; n < coupled.flow.instance_count(); ++n)
      result.push_back(kinematics.motion(std::span<const double>(state.y).subspan(4 * n, 4), state.r));
    return result;
  }

  // Steady flow; speed, frequency and shape of the cycle well off.
  void set_start(double energy) {
    Eigen::VectorXcd mode = reference.root.mode;
    mode[plunge_mode] *= std::polar(1.1, 0.1);
    start.omega = 1.03 * reference.state.omega;
    start.r = 0.9 * reference.state.r;
    start.y = harmonic_states(coupled.model, coupled.time,
                              scaled_to_energy(coupled.model, mode, start.omega, energy), start.omega);
    const std::vector<double> steady = steady_state(coupled);
    for (int n = 0; n < coupled.time.instances(); ++n)
      start.w.insert(start.w.end(), steady.begin(), steady.end());
  }

  FlowCycle cycle() {
    return [this](std::span<double> w, std::span<const MotionState> moved, double kappa_now) {
      std::vector<double> r(w.size()), change(w.size(), 0.0);
      coupled.flow.linearize_state(w, moved, kappa_now);
      coupled.flow.residual(w, moved, kappa_now, r);
      gmres<double>(coupled.comm(), FlowOperator(coupled.flow), preconditioner, r, change,
                    {.relative_tolerance = 0.2, .restart = 20, .max_iterations = 20});
      for (std::size_t i = 0; i < w.size(); ++i) w[i] -= change[i];
    };
  }

  StaggeredResult solve(const CycleAmplitude& amplitude, AeroelasticState& state,
                        const StaggeredObserver& observer = {}) {
    state = start;
    return solve_staggered<2>(cycle(), coupled.flow, structure, kinematics, amplitude, state, options,
                              observer);
  }
};

// Flutter of small amplitude, solved by Newton once for all tests.
class StaggeredFlutter : public ::testing::Test {
 protected:
  static constexpr double energy = 1e-6;
  static void SetUpTestSuite() { shared = std::make_unique<StaggeredCase>(energy); }
  static void TearDownTestSuite() { shared.reset(); }
  void TearDown() override {
    c.options = {.flow_cycles = 1, .max_iterations = steps_allowed};
    c.kinematics.mean_pitch = 0.0;
  }

  static std::unique_ptr<StaggeredCase> shared;
  StaggeredCase& c = *shared;
  AeroelasticState state;
};
std::unique_ptr<StaggeredCase> StaggeredFlutter::shared;

// Along the direction that converges last, V is off by 5 and omega by 0.5 times |S|/s, which is 1e-9 at
// the end, however large it is where a run is stopped.
void expect_same(const AeroelasticState& state, const AeroelasticState& reference) {
  EXPECT_NEAR(std::sqrt(state.r), std::sqrt(reference.r), 2e-8);
  EXPECT_NEAR(state.omega, reference.omega, 2e-9);
  ASSERT_EQ(state.y.size(), reference.y.size());
  double size = 0.0, distance = 0.0;
  for (std::size_t i = 0; i < state.y.size(); ++i) {
    size += std::pow(reference.y[i], 2);
    distance += std::pow(state.y[i] - reference.y[i], 2);
  }
  EXPECT_LE(std::sqrt(distance / size), 1e-8);
}

// Residuals are those of the coupled problem.
void expect_coupled_residuals(StaggeredCase& c, const AeroelasticState& state,
                              const AeroelasticResiduals& expected) {
  AeroelasticProblem<2>& problem = *c.coupled.problem;
  std::vector<double> u = problem.unknowns(state), f(u.size());
  ASSERT_TRUE(problem.residual(u, f));
  const AeroelasticResiduals same = problem.measure(f);
  EXPECT_NEAR(expected.flow, same.flow, 1e-2 * same.flow + 1e-11);  // round-off of s w^
  EXPECT_NEAR(expected.structure, same.structure, 1e-12);
  EXPECT_NEAR(expected.phase, same.phase, 1e-12);
  EXPECT_NEAR(expected.energy, same.energy, 1e-12);
}

void expect_coupled_solution(StaggeredCase& c, double energy) {
  AeroelasticState state;
  const StaggeredResult result = c.solve(GivenEnergy{energy}, state);
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_EQ(result.recoveries, 0);
  EXPECT_LE(result.iterations, 80);
  EXPECT_EQ(result.flow_cycles, c.options.flow_cycles * result.iterations);
  expect_same(state, c.reference.state);
  EXPECT_NEAR(fluctuating_energy(c.coupled.model, state.y), energy, 1e-12 * energy);
  expect_coupled_residuals(c, state, result.residuals);
}

TEST_F(StaggeredFlutter, EndsAtTheCoupledSolution) { expect_coupled_solution(c, energy); }

TEST(StaggeredCycle, OfFiniteAmplitudeEndsAtTheCoupledSolution) {
  StaggeredCase finite(1e-3, 2);
  expect_coupled_solution(finite, 1e-3);
}

// A static deflection of several times the amplitude must neither set the speed nor the energy.
TEST_F(StaggeredFlutter, AboutADeflectedMeanSolvesTheCoupledEquations) {
  const double mean_pitch = 0.005;
  c.kinematics.mean_pitch = mean_pitch;
  const StaggeredResult result = c.solve(GivenEnergy{energy}, state);
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_EQ(result.recoveries, 0);
  const double mean = (state.y[1] + state.y[5] + state.y[9]) / 3.0;
  EXPECT_GT(std::abs(mean), 2.0 * std::abs(state.y[5] - mean));
  const std::vector<double> base(state.w.begin(),
                                 state.w.begin() + static_cast<std::ptrdiff_t>(state.w.size() / 3));
  c.coupled.pose({base, {state.y[0], mean, 0.0, 0.0}, 0.0, 1.0}, energy, mean_pitch);
  expect_coupled_residuals(c, state, result.residuals);
  EXPECT_NEAR(std::sqrt(state.r), std::sqrt(c.reference.state.r), 0.1);
}

TEST_F(StaggeredFlutter, AgreesOnAnyNumberOfRanks) {
  StaggeredCase together(energy, 1, 3, Comm());
  EXPECT_EQ(together.solve(GivenEnergy{energy}, state).status, SolveStatus::converged);
  expect_same(state, c.reference.state);
}

TEST(StaggeredCycle, OfAGivenSpeedHasItsEnergy) {
  const double energy = 5e-4;
  StaggeredCase c(energy);
  const double v = std::sqrt(c.reference.state.r);
  AeroelasticState state;
  const StaggeredResult result = c.solve(GivenSpeed{v, 0.5 * energy}, state);
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_LE(result.residuals.energy, c.options.tolerances.structure);
  EXPECT_NEAR(std::sqrt(state.r), v, 1e-9 * v);
  EXPECT_NEAR(state.omega, c.reference.state.omega, 1e-8);
  // V^2 rises by about 1 % over this energy, so that its errors of 1e-9 return a hundredfold.
  EXPECT_NEAR(fluctuating_energy(c.coupled.model, state.y), energy, 1e-5 * energy);
}

// A flow solver that fails once is survived, one that always fails is given up, with the best state kept.
TEST_F(StaggeredFlutter, FailuresOfTheFlowSolver) {
  const FlowCycle sound = c.cycle();
  for (bool always : {false, true}) {
    int calls = 0;
    const FlowCycle unsound = [&](std::span<double> w, std::span<const MotionState> moved, double kappa) {
      ++calls;
      if (always ? calls > 6 : calls == 7)
        w[0] = std::numeric_limits<double>::quiet_NaN();
      else
        sound(w, moved, kappa);
    };
    state = c.start;
    const StaggeredResult result = solve_staggered<2>(unsound, c.coupled.flow, c.structure, c.kinematics,
                                                      GivenEnergy{energy}, state, c.options);
    EXPECT_EQ(result.status, always ? SolveStatus::diverged : SolveStatus::converged);
    EXPECT_EQ(result.recoveries, always ? c.options.max_recoveries : 1);
    for (double value : state.w) ASSERT_TRUE(std::isfinite(value));
    if (!always) expect_same(state, c.reference.state);
  }
}

// Also with the energy sought that has a speed, whose search has a state of its own.
TEST_F(StaggeredFlutter, GoesOnBitForBitFromAnyIteration) {
  const double v = c.kinematics.reduced_velocity(c.reference.state.r);
  for (const CycleAmplitude& amplitude :
       {CycleAmplitude(GivenEnergy{energy}), CycleAmplitude(GivenSpeed{v, 0.5 * energy})}) {
    c.options.max_iterations = 60;
    AeroelasticState whole;
    const auto numbers = [](const StaggeredResult& result) {
      return std::tuple(result.flow_cycles, result.recoveries, result.residuals.flow,
                        result.residuals.structure);
    };
    const auto expected = numbers(c.solve(amplitude, whole));
    for (const int left : {1, 23}) {
      const auto begun = c.solve(amplitude, state, [&](const auto& at) { return at.iteration < left; });
      ASSERT_TRUE(begun.memory);
      StaggeredOptions rest = c.options;
      rest.max_iterations -= left;
      const auto result = solve_staggered<2>(c.cycle(), c.coupled.flow, c.structure, c.kinematics, amplitude,
                                             state, rest, {}, &*begun.memory);
      EXPECT_EQ(numbers(result), expected) << left;
      EXPECT_EQ(state.w, whole.w);
      EXPECT_EQ(state.y, whole.y);
      EXPECT_EQ(state.omega, whole.omega);
      EXPECT_EQ(state.r, whole.r);
    }
  }
}

TEST_F(StaggeredFlutter, StopsWhenToldAndAtItsLimit) {
  int seen = 0;
  const auto stop = [&](const StaggeredIteration& at) {
    EXPECT_EQ(at.iteration, seen);
    return ++seen < 4;
  };
  EXPECT_EQ(c.solve(GivenEnergy{energy}, state, stop).status, SolveStatus::interrupted);
  EXPECT_EQ(seen, 4);
  c.options.max_iterations = 5;
  const StaggeredResult result = c.solve(GivenEnergy{energy}, state);
  EXPECT_EQ(result.status, SolveStatus::iteration_limit);
  EXPECT_EQ(result.iterations, 5);
}

}  // namespace
}  // namespace wingbeat
