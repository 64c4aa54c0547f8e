#include <gtest/gtest.h>

#include "test/flow/multigrid_case.hpp"
#include "test/nightly.hpp"

namespace wingbeat {
namespace {

using namespace testing;

// Cycles allowed: a fifth more than it takes.
void expect_ten_orders(MultigridCase& c, int cycles, const std::string& name) {
  const auto result = solve_by_cycles(c, {}).result;
  EXPECT_EQ(result.status, SolveStatus::converged) << name;
  EXPECT_LE(result.residual, 1e-10) << name;
  EXPECT_LE(result.cycles, cycles) << name;
  EXPECT_EQ(result.retreats, 0) << name;
}

struct Section {
  const char* name;
  double mach, angle_deg;
  int cycles;
};

void expect_ten_orders(const Section& s, int around, int normal) {
  MultigridCase c(section_mesh(s.name, around, normal, 1, 60.0), s.mach, s.angle_deg);
  expect_ten_orders(c, s.cycles,
                    std::string(s.name) + " at Mach " + std::to_string(s.mach) + " on " +
                        std::to_string(around) + " x " + std::to_string(normal));
}

TEST(MultigridConvergence, ResidualOfSteadyFlowFallsTenOrders) {
  for (const Section& s :
       {Section{"naca0012", 0.5, 0.0, 185}, {"naca0012", 0.8, 1.25, 295}, {"naca64a010", 0.8, 0.0, 305}})
    expect_ten_orders(s, 128, 32);
  if (!is_nightly()) return;
  for (const Section& s :
       {Section{"naca0012", 0.5, 0.0, 220}, {"naca0012", 0.8, 1.25, 430}, {"naca64a010", 0.8, 0.0, 530}})
    expect_ten_orders(s, 256, 64);
  // 25 is odd: one coarse mesh is all that 250 x 50 has.
  expect_ten_orders({"naca64a010", 0.8, 0.0, 500}, 250, 50);
}

// Case CT6 of AGARD R-702: NACA 64A010 at Mach 0.796, 1.01 deg about the quarter chord, k = 0.202.
void expect_ten_orders_of_ct6(int around, int normal, int harmonics, int cycles) {
  MultigridCase c(section_mesh("naca64a010", around, normal, 1, 60.0), 0.796, 0.0, TimeSpectral(harmonics),
                  0.202, 1.01);
  expect_ten_orders(c, cycles, std::to_string(c.flow.instance_count()) + " instances");
}

TEST(MultigridConvergence, ResidualOfForcedPitchFallsTenOrders) {
  expect_ten_orders_of_ct6(64, 16, 1, 305);
  if (!is_nightly()) return;
  expect_ten_orders_of_ct6(128, 32, 1, 345);
  expect_ten_orders_of_ct6(128, 32, 2, 355);
  expect_ten_orders_of_ct6(128, 32, 3, 340);
}

int cycles_of_pitch(int harmonics, double reduced_frequency) {
  MultigridCase c(section_mesh("naca64a010", 64, 16, 1, 60.0), 0.796, 0.0, TimeSpectral(harmonics),
                  reduced_frequency, 0.1);
  PseudoTimeOptions options;
  options.tolerance = 1e-8;
  const auto result = solve_by_cycles(c, options).result;
  EXPECT_EQ(result.status, SolveStatus::converged);
  return result.cycles;
}

// Held back, a harmonic takes its own shorter step and the others do not: neither the number of
// harmonics nor a frequency ten times as high costs more than a tenth of the cycles.
TEST(MultigridConvergence, CyclesHardlyGrowWithHarmonicsOrFrequency) {
  const int steady = cycles_of_pitch(0, 0.0);
  for (const auto& [harmonics, k] : {std::pair{1, 0.2}, {3, 0.2}, {1, 2.0}})
    EXPECT_LE(cycles_of_pitch(harmonics, k), 1.1 * steady) << harmonics << " harmonics at k = " << k;
}

}  // namespace
}  // namespace wingbeat
