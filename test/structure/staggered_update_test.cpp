// The staggered iteration's steps on the structure, with loads of a linear flow in place of a solver.
#include "structure/staggered_update.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/io/error.hpp"
#include "structure/conditions.hpp"
#include "structure/energy.hpp"
#include "structure/flutter_roots.hpp"
#include "structure/harmonic_motion.hpp"
#include "structure/staggered_energy_search.hpp"
#include "structure/theodorsen.hpp"
#include "structure/typical_section.hpp"

namespace wingbeat {
namespace {

using Values = std::vector<double>;

const TypicalSection section{-0.6, .25, .75, .5, 75.0, {}};

Values difference(const Values& a, const Values& b) {
  Values result(a);
  for (std::size_t i = 0; i < a.size(); ++i) result[i] -= b[i];
  return result;
}

double norm(const Values& x) {
  double sum = 0.0;
  for (double value : x) sum += value * value;
  return std::sqrt(sum);
}

// A cycle that flutters in the linear flow of Theodorsen's flat plate: its exact state and loads.
struct LinearFlutterCycle {
  StructuralEquation structure;
  double energy = 1e-4;
  double omega = 0.0, load = 0.0;
  Values y, f;

  explicit LinearFlutterCycle(int harmonics) : structure(structure_model(section), TimeSpectral(harmonics)) {
    const AerodynamicMatrix q = [](double k) { return theodorsen_matrix(section.elastic_axis, k); };
    FlutterRoot root;
    for (const auto& each :
         flutter_roots(structure.model(), q, tabulate(q, spread_reduced_frequencies(0.02, 0.6, 24))))
      if (each.is_destabilising()) root = each;
    omega = root.frequency;
    load = structure.model().load(root.reduced_velocity);
    const Eigen::VectorXcd mode = scaled_to_energy(structure.model(), root.mode, omega, energy);
    y = harmonic_states(structure.model(), structure.time(), mode, omega);
    const Eigen::VectorXcd force = q(root.reduced_frequency) * mode;
    for (int n = 0; n < structure.time().instances(); ++n)
      for (int j = 0; j < 2; ++j) f.push_back((force[j] * std::polar(1.0, structure.time().phase(n))).real());
  }

  const StructureModel& model() const { return structure.model(); }
  const TimeSpectral& time() const { return structure.time(); }
  Values residual() const {
    Values s(y.size());
    structure.residual(y, omega, load, f, s);
    return s;
  }
};

// All harmonics, a mean, unequal modes: nothing special.
Values arbitrary_cycle(const StructuralEquation& structure) {
  Values y;
  for (std::size_t i = 0; i < structure.state_size(); ++i)
    y.push_back(0.3 + std::sin(1.7 * static_cast<double>(i) + 0.4) +
                0.2 * std::cos(0.3 * static_cast<double>(i * i)));
  return y;
}

TEST(StaggeredUpdate, ASolutionIsAFixedPoint) {
  for (int harmonics : {1, 3}) {
    const LinearFlutterCycle cycle(harmonics);
    const double round_off = 1e-9 * norm(cycle.y);  // of the flutter root
    ASSERT_LE(norm(cycle.residual()), round_off);
    for (double dtau : {0.1, 10.0})
      EXPECT_LE(
          norm(difference(structural_step(cycle.structure, cycle.y, cycle.omega, cycle.load, cycle.f, dtau),
                          cycle.y)),
          20.0 * round_off);
    EXPECT_LE(norm(difference(scaled_to_energy(cycle.model(), cycle.y, cycle.energy), cycle.y)), round_off);
    EXPECT_LE(norm(difference(shifted_to_phase(cycle.model(), cycle.time(), cycle.y), cycle.y)), round_off);
    const FrequencyAndLoad fitted = fitted_frequency_and_load(cycle.structure, cycle.y, cycle.f);
    EXPECT_NEAR(fitted.omega, cycle.omega, 1e-8);
    EXPECT_NEAR(fitted.load, cycle.load, 1e-8);
    EXPECT_NEAR(fitted_frequency(cycle.structure, cycle.y, cycle.f, cycle.load), cycle.omega, 1e-8);
  }
}

// Linear in y+ without restoring forces: one step solves (y+ - y)/dtau + S(y+) = 0 for the fluctuation;
// of the mean residual half is left.
TEST(StaggeredUpdate, TheStructuralStepIsImplicitEulerAndHalvesTheMeanResidual) {
  const LinearFlutterCycle cycle(2);
  const Values y = arbitrary_cycle(cycle.structure);
  const double omega = 0.8, load = 0.2, dtau = 3.0;
  Values f;
  for (std::size_t i = 0; i < cycle.f.size(); ++i) f.push_back(std::cos(static_cast<double>(i)));
  const Values next = structural_step(cycle.structure, y, omega, load, f, dtau);
  Values s(y.size()), s_next(y.size());
  cycle.structure.residual(y, omega, load, f, s);
  cycle.structure.residual(next, omega, load, f, s_next);
  const auto harmonics = [&](const Values& values) { return cycle.time().harmonics_of(values); };
  const auto change = harmonics(difference(next, y)), before = harmonics(s), after = harmonics(s_next);
  for (std::size_t i = 0; i < change.size(); ++i)
    EXPECT_LE(std::abs(i < 4 ? after[i] - 0.5 * before[i] : change[i] / dtau + after[i]), 1e-13);
}

TEST(StaggeredUpdate, ScalingSetsTheFluctuatingEnergyAndKeepsTheMean) {
  const StructuralEquation structure(structure_model(section), TimeSpectral(2));
  const Values y = arbitrary_cycle(structure);
  const Values scaled = scaled_to_energy(structure.model(), y, 1e-3);
  EXPECT_NEAR(fluctuating_energy(structure.model(), scaled), 1e-3, 1e-16);
  const auto before = structure.time().harmonics_of(y), after = structure.time().harmonics_of(scaled);
  const double factor = after[4].real() / before[4].real();
  EXPECT_GT(factor, 0.0);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LE(std::abs(after[i] - (i < 4 ? 1.0 : factor) * before[i]), 1e-14);
}

// The same functions of time: what each harmonic is at phase theta + shift.
TEST(StaggeredUpdate, ShiftingIsAShiftInTimeToASineOfPositiveAmplitude) {
  const StructuralEquation structure(structure_model(section), TimeSpectral(2));
  const Values y = arbitrary_cycle(structure);
  const Values shifted = shifted_to_phase(structure.model(), structure.time(), y);
  const std::complex<double> first = structure.time().harmonics_of(shifted)[4 + pitch_mode];
  EXPECT_NEAR(first.real(), 0.0, 1e-15);
  EXPECT_LT(first.imag(), 0.0);
  const auto phase = phase_condition(structure.model(), structure.time());
  EXPECT_NEAR(value(AmplitudeCondition(phase), shifted), 0.0, 1e-15);

  const auto c = structure.time().harmonics_of(y), d = structure.time().harmonics_of(shifted);
  const double shift = std::arg(d[4] / c[4]);
  for (std::size_t i = 0; i < c.size(); ++i)
    EXPECT_LE(std::abs(d[i] - c[i] * std::polar(1.0, static_cast<double>(i / 4) * shift)), 1e-14);
  EXPECT_NEAR(fluctuating_energy(structure.model(), shifted), fluctuating_energy(structure.model(), y),
              1e-14);
}

TEST(StaggeredUpdate, ASectionWithoutPitchCannotBeShifted) {
  const StructuralEquation structure(structure_model(section), TimeSpectral(1));
  const Values y = harmonic_states(structure.model(), structure.time(), Eigen::Vector2cd(1.0, 0.0), 0.5);
  EXPECT_THROW(shifted_to_phase(structure.model(), structure.time(), y), InputError);
}

// The fluctuating residual is orthogonal to its derivatives; a static load, however large, changes nothing.
TEST(StaggeredUpdate, FitsMakeTheFluctuatingResidualLeast) {
  const LinearFlutterCycle cycle(2);
  const Values y = arbitrary_cycle(cycle.structure);
  Values f, lifted;
  for (std::size_t i = 0; i < cycle.f.size(); ++i) {
    f.push_back(std::cos(static_cast<double>(i)));
    lifted.push_back(f.back() + (i % 2 == 0 ? 1e3 : -2e3));
  }
  const auto size_of_fluctuation = [&](double omega, double load) {
    Values s(y.size());
    cycle.structure.residual(y, omega, load, f, s);
    const auto harmonics = cycle.time().harmonics_of(s);
    double sum = 0.0;
    for (std::size_t i = 4; i < harmonics.size(); ++i) sum += std::norm(harmonics[i]);
    return sum;
  };
  const FrequencyAndLoad best = fitted_frequency_and_load(cycle.structure, y, f);
  const double least = size_of_fluctuation(best.omega, best.load);
  for (double step : {-1e-3, 1e-3}) {
    EXPECT_GT(size_of_fluctuation(best.omega + step, best.load), least);
    EXPECT_GT(size_of_fluctuation(best.omega, best.load + step), least);
  }
  const FrequencyAndLoad same = fitted_frequency_and_load(cycle.structure, y, lifted);
  EXPECT_NEAR(same.omega, best.omega, 1e-11);
  EXPECT_NEAR(same.load, best.load, 1e-11);

  const double load = 0.3, omega = fitted_frequency(cycle.structure, y, f, load);
  for (double step : {-1e-3, 1e-3})
    EXPECT_GT(size_of_fluctuation(omega + step, load), size_of_fluctuation(omega, load));
}

// The whole iteration with loads that answer at once, from a start well off the solution.
TEST(StaggeredUpdate, RepeatedItConvergesToTheFlutterPoint) {
  const LinearFlutterCycle cycle(1);
  const auto loads = [&](const Values& y, double omega, double load) {
    const double v = std::sqrt(load / cycle.model().load(1.0));
    const Eigen::VectorXcd force = theodorsen_matrix(section.elastic_axis, omega / (2.0 * v)) *
                                   first_harmonic(cycle.model(), cycle.time(), y);
    Values f;
    for (int n = 0; n < 3; ++n)
      for (int j = 0; j < 2; ++j) f.push_back((force[j] * std::polar(1.0, cycle.time().phase(n))).real());
    return f;
  };
  FrequencyAndLoad at{1.05 * cycle.omega, 0.8 * cycle.load};
  Values y = cycle.y;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] *= i % 4 == 0 ? 0.7 : 1.0;
  int steps = 0;
  for (; steps < 200; ++steps) {
    const Values f = loads(y, at.omega, at.load);
    Values s(y.size());
    cycle.structure.residual(y, at.omega, at.load, f, s);
    if (norm(s) <= 1e-10 * norm(y)) break;
    y = structural_step(cycle.structure, y, at.omega, at.load, f, 2.0 * std::numbers::pi / at.omega);
    y = shifted_to_phase(cycle.model(), cycle.time(), scaled_to_energy(cycle.model(), y, cycle.energy));
    at = fitted_frequency_and_load(cycle.structure, y, f);
  }
  EXPECT_LT(steps, 200);
  EXPECT_NEAR(at.omega, cycle.omega, 1e-8);
  EXPECT_NEAR(at.load, cycle.load, 1e-8);
}

TEST(EnergySearch, FindsTheEnergyOnABentBranchEitherWay) {
  for (double slope : {40.0, -40.0}) {
    const auto r = [slope](double energy) { return 8.3 + slope * energy + 900.0 * energy * energy; };
    const double expected = 4e-3;
    EnergySearch search(r(expected), 1e-3);
    int steps = 0;
    while (std::abs(search.mismatch(r(search.energy()))) > 1e-12 && ++steps < 20)
      search.advance(r(search.energy()));
    EXPECT_LE(steps, 10);
    EXPECT_NEAR(search.energy(), expected, 1e-10);
  }
  EXPECT_THROW(EnergySearch(0.0, 1.0), InputError);
  EXPECT_THROW(EnergySearch(1.0, 0.0), InputError);
}

}  // namespace
}  // namespace wingbeat
