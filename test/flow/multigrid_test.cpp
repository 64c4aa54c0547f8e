#include "flow/multigrid.hpp"

#include <gtest/gtest.h>

#include "flow/forced_flow.hpp"
#include "flow/spectral_radius.hpp"
#include "flow/steady_sequence.hpp"
#include "test/flow/multigrid_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;

MultiblockMesh<2> small_mesh() { return section_mesh("naca64a010", 64, 16, 1, 60.0); }

// The same equations solved by Newton's method, to `tolerance`.
struct NewtonSolution {
  std::unique_ptr<FlowLevel<2>> level;
  std::vector<double> w;
};

NewtonSolution solve_by_newton(MultigridCase& c, double tolerance) {
  FlowLevels<2> levels;
  levels.push_back(std::make_unique<FlowLevel<2>>(
      c.comm, c.mesh, c.flow.model(), c.domain.axis(),
      FlowLevelOptions{.partition = {.imbalance = 0.05, .granularity = 16}, .subdomain = {.overlap = 3}}));
  FlowLevel<2>& level = *levels.back();
  PseudoTransientOptions steady;
  steady.tolerance = tolerance;
  EXPECT_EQ(solve_steady<2>(levels, {}, steady).status, SolveStatus::converged);
  if (c.flow.time().harmonics() == 0) return {std::move(levels.back()), level.w};
  ForcedFlowStart start = steady_start<2>(level, c.flow.time());
  ForcedFlowOptions options;
  options.tolerance = tolerance;
  EXPECT_EQ(solve_forced_flow<2>(c.flow, start.factors, c.motions, c.kappa, start.w, options).status,
            SolveStatus::converged);
  return {std::move(levels.back()), start.w};
}

TEST(Multigrid, HasTheLevelsAndTheWorkOfItsMesh) {
  MultigridCase c(small_mesh(), 0.8, 0.0);
  const auto made = [&](std::optional<int> levels, int recursion) {
    MultigridOptions options;
    options.levels = levels;
    options.recursion = recursion;
    const Multigrid<2> multigrid(c.flow, c.divided(), options);
    return std::pair(multigrid.levels(), multigrid.work());
  };
  // 64 x 16, 32 x 8 and 16 x 4. A quarter of the cells before and after its correction; a
  // sixteenth by four steps. A W cycle does either twice.
  EXPECT_EQ(made({}, 2), std::pair(3, 1.0 + 2 * 2 / 4.0 + 2 * 4 / 16.0));
  EXPECT_EQ(made({}, 1), std::pair(3, 1.0 + 2 / 4.0 + 4 / 16.0));
  EXPECT_EQ(made(2, 1), std::pair(2, 1.0 + 4 / 4.0));
  EXPECT_EQ(made(1, 2), std::pair(1, 1.0));
}

// Full approximation storage: coarse meshes correct by what the fine residual asks for and by nothing
// of their own, so that a cycle moves a solution by no more than its residual does.
TEST(Multigrid, CycleLeavesASolutionAlone) {
  for (int harmonics : {0, 1}) {
    MultigridCase c(small_mesh(), 0.8, 0.0, TimeSpectral(harmonics), harmonics * 0.2, 1.0);
    auto w = solve_by_newton(c, 1e-11).w;
    const auto solution = w;
    std::vector<double> r(w.size());
    c.flow.residual(w, c.motions, c.kappa, r);
    double longest = 0.0;  // dtau / Omega
    for (double sum : spectral_radius_sums<2>(c.domain, {w.data(), c.domain.state_count()}, {}, 1.4))
      longest = std::max(longest, RungeKuttaOptions{}.cfl / sum);
    // Every mesh adds steps of about that length times the residual of a coarse cell, the sum of that
    // of its cells.
    const double allowed = 50.0 * c.comm.max(longest) * global_norm(c.comm, r);
    Multigrid<2> multigrid(c.flow, c.divided(), {});
    multigrid.cycle(w, c.motions, c.kappa, {});
    EXPECT_LE(largest_difference(c.comm, w, solution), allowed);
    EXPECT_LE(allowed, 1e-6) << "the bound must say something";
  }
}

TEST(Multigrid, ReachesTheSolutionOfNewtonsMethod) {
  for (int harmonics : {0, 1}) {
    MultigridCase c(section_mesh("naca0012", 64, 16, 1, 60.0), 0.8, 1.25, TimeSpectral(harmonics),
                    harmonics * 0.2, 1.0);
    PseudoTimeOptions options;
    options.tolerance = 1e-11;
    const CycledSolution cycled = solve_by_cycles(c, options);
    ASSERT_EQ(cycled.result.status, SolveStatus::converged);
    EXPECT_LE(relative_residual(c, cycled.w), 1.001e-11);
    const auto w = solve_by_newton(c, 1e-11).w;
    EXPECT_LE(largest_difference(c.comm, cycled.w, w), 1e-8) << harmonics << " harmonics";
    const auto loads = loads_of(c, w);
    for (std::size_t k = 0; k < loads.size(); ++k) EXPECT_NEAR(cycled.loads[k], loads[k], 1e-9);
  }
}

TEST(Multigrid, PathDependsOnRanksAndBlocksByTheSmoothingsTruncationOnly) {
  const auto solved = [](int blocks, const Comm& ranks) {
    MultigridCase c(section_mesh("naca0012", 96, 32, blocks, 60.0), 0.8, 1.25, TimeSpectral(0), 0.0, 0.0,
                    ranks);
    PseudoTimeOptions options;
    options.tolerance = 1e-11;
    return solve_by_cycles(c, options);
  };
  const auto alone = solved(1, Comm(MPI_COMM_SELF));
  for (int blocks : {1, 3}) {
    const auto together = solved(blocks, Comm());
    EXPECT_EQ(together.result.status, SolveStatus::converged);
    EXPECT_NEAR(together.result.cycles, alone.result.cycles, 0.02 * alone.result.cycles + 1) << blocks;
    for (std::size_t k = 0; k < alone.loads.size(); ++k)
      EXPECT_NEAR(together.loads[k], alone.loads[k], 1e-9) << blocks;
  }
}

}  // namespace
}  // namespace wingbeat
