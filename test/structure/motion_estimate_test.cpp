// Growth, frequency and limit cycle of motions that are known: two modes, noise, an amplitude that settles.
#include "structure/motion_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "structure/cycle_estimate.hpp"
#include "structure/energy.hpp"
#include "structure/harmonic_motion.hpp"
#include "structure/march_verdict.hpp"
#include "test/structure/quasi_steady_section.hpp"

namespace wingbeat {
namespace {

using Complex = std::complex<double>;
using Values = std::vector<double>;

const StructureModel section = testing::QuasiSteadySection().model();
constexpr double pitch_period = 2.0 * std::numbers::pi;
constexpr double dtau = pitch_period / 96;

// Displacements Re(shape e^{pt}) and their rates.
struct Motion {
  Complex p;
  Eigen::Vector2cd shape;
};

Values record_of(const std::vector<Motion>& motions, int samples, const Values& mean = Values(4, 0.0)) {
  Values record;
  for (int n = 0; n < samples; ++n) {
    Eigen::Vector4d y(mean.data());
    for (const Motion& motion : motions) {
      const Eigen::Vector2cd u = motion.shape * std::exp(motion.p * (n * dtau));
      y.head(2) += u.real();
      y.tail(2) += (motion.p * u).real();
    }
    record.insert(record.end(), y.data(), y.data() + 4);
  }
  return record;
}

const Motion flutter{{0.004, 0.65}, {Complex(0.02, 0.01), Complex(0.01, 0.0)}};
const Motion decaying{{-0.06, 1.05}, {Complex(-0.005, 0.0), Complex(0.01, 0.004)}};

TEST(MotionEstimate, FitsTwoModesAboutAMeanExactly) {
  const Values record = record_of({flutter, decaying}, 600, {0.03, -0.02, 0.0, 0.0});
  const auto fit = fit_damped_modes(section, {record, dtau}, 2);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->residual, 1e-10);
  const bool first = fit->modes[0].rate > fit->modes[1].rate;
  const DampedMode &a = fit->modes[first ? 0 : 1], &b = fit->modes[first ? 1 : 0];
  EXPECT_NEAR(a.rate, flutter.p.real(), 1e-10);
  EXPECT_NEAR(a.frequency, flutter.p.imag(), 1e-10);
  EXPECT_NEAR(b.rate, decaying.p.real(), 1e-9);
  EXPECT_NEAR(b.frequency, decaying.p.imag(), 1e-9);
}

// Of a mode alone: its energy at the end of the record, as an average over a period.
TEST(MotionEstimate, KnowsTheEnergyOfAMode) {
  const Motion neutral{{0.0, 0.65}, flutter.shape};
  const auto fit = fit_damped_modes(section, {record_of({neutral}, 500), dtau}, 1);
  ASSERT_TRUE(fit);
  const Values period = harmonic_states(section, TimeSpectral(1), neutral.shape, 0.65);
  EXPECT_NEAR(fit->modes[0].energy, average_energy(section, period), 1e-12);
}

// Over many records with noise the error is one standard deviation of what the rate is wrong by, or more:
// it also counts the disagreement of halves, which is 2.6 standard deviations.
TEST(MotionEstimate, ErrorsAreHonestAboutNoise) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1e-4);
  const Values clean = record_of({flutter, decaying}, 500);
  constexpr int records = 60;
  int missed = 0;
  double squares = 0.0, errors = 0.0;
  for (int i = 0; i < records; ++i) {
    Values record = clean;
    for (double& value : record) value += noise(random);
    const auto growth = estimate_growth(section, {record, dtau});
    ASSERT_TRUE(growth);
    const double wrong = std::abs(growth->rate - flutter.p.real());
    missed += wrong > 3.0 * growth->rate_error;
    squares += wrong * wrong;
    errors += growth->rate_error / records;
  }
  EXPECT_LE(missed, 2);
  const double deviation = std::sqrt(squares / records);
  EXPECT_GT(errors, 0.8 * deviation);
  EXPECT_LT(errors, 6.0 * deviation);
}

// A third mode that the fit does not know, as lags of the flow make, spoils early records more than late
// ones.
TEST(MotionEstimate, ErrorsAreHonestAboutUnfinishedTransients) {
  const Motion lag{{-0.15, 0.4}, {Complex(0.01, 0.0), Complex(0.0, 0.01)}};
  const Values record = record_of({flutter, decaying, lag}, 96 * 16);
  double last = 1.0;
  for (const int periods : {4, 6, 8, 12, 16}) {
    const auto from = static_cast<std::size_t>(4 * 96 * periods / 3);
    const auto growth = estimate_growth(
        section,
        {std::span<const double>(record).first(static_cast<std::size_t>(4 * 96 * periods)).subspan(from),
         dtau});
    ASSERT_TRUE(growth) << periods;
    EXPECT_LE(std::abs(growth->rate - flutter.p.real()), 3.0 * growth->rate_error) << periods << " periods";
    EXPECT_LE(std::abs(growth->frequency - flutter.p.imag()), 3.0 * growth->frequency_error) << periods;
    EXPECT_LT(growth->rate_error, last) << periods;
    last = growth->rate_error;
  }
  EXPECT_LT(last, 1e-4);
}

TEST(MotionEstimate, IsOfTheLeastStableModeThoughAnotherIsLarger) {
  Motion large = decaying;
  large.shape *= 4.0;
  large.p = {-0.01, 1.05};
  const auto growth = estimate_growth(section, {record_of({flutter, large}, 800), dtau});
  ASSERT_TRUE(growth);
  EXPECT_NEAR(growth->rate, flutter.p.real(), 1e-8);
}

// Amplitude a(t) of a Stuart-Landau oscillator, a' = sigma a (1 - a^2): the energy approaches its limit.
Values settling_record(double sigma, double first, int samples) {
  Values record;
  for (int n = 0; n < samples; ++n) {
    const double t = n * dtau, growth = std::exp(2.0 * sigma * t);
    const double a = std::sqrt(first * first * growth / (1.0 + first * first * (growth - 1.0)));
    const Eigen::Vector2cd u = a * flutter.shape * std::polar(1.0, 0.65 * t);
    for (int j = 0; j < 2; ++j) record.push_back(u[j].real());
    for (int j = 0; j < 2; ++j) record.push_back((Complex(0.0, 0.65) * u[j]).real());
  }
  return record;
}

const double settled_energy =
    average_energy(section, harmonic_states(section, TimeSpectral(1), flutter.shape, 0.65));

TEST(CycleEstimate, FindsTheLimitOfTheEnergyFromBothSides) {
  for (const double first : {0.6, 1.5}) {
    const Values record = settling_record(0.01, first, 96 * 14);
    const auto cycle = estimate_cycle(periods_of(section, {record, dtau}));
    ASSERT_TRUE(cycle);
    EXPECT_NEAR(cycle->energy_limit, settled_energy, 0.01 * settled_energy);
    EXPECT_GE(cycle->energy_error, 0.7 * std::abs(cycle->energy - settled_energy));
    EXPECT_NEAR(cycle->frequency, 0.65, 1e-3 * 0.65);
  }
}

TEST(CycleEstimate, DoesNotTakeSteadyGrowthOrDecayForACycle) {
  for (const double rate : {0.01, -0.01}) {
    const Values record = record_of({{{rate, 0.65}, flutter.shape}}, 96 * 14);
    const auto cycle = estimate_cycle(periods_of(section, {record, dtau}));
    EXPECT_TRUE(!cycle || cycle->energy_error > 0.5 * cycle->energy);
  }
}

// A weakly attracting cycle, begun near it with a transient that halves every period: all growths together
// fall with the transient, not with the energy.
TEST(CycleEstimate, IsNotMisledByATransientNearTheCycle) {
  std::vector<MarchedPeriod> periods{{0.0, pitch_period / 0.65, 0.995 * settled_energy}};
  for (double transient = 2e-4; periods.size() < 6; transient /= 2.0) {
    MarchedPeriod next = periods.back();
    next.begin += next.period;
    next.energy *= std::exp(0.035 * (1.0 - next.energy / settled_energy) + transient);
    periods.push_back(next);
  }
  const auto cycle = estimate_cycle(periods);
  EXPECT_TRUE(!cycle || cycle->energy_error > 0.5 * std::abs(cycle->energy - settled_energy));
}

// A period sampled as a periodic solution holds it: a sine in pitch, the mean kept.
TEST(CycleEstimate, SamplesAPeriodWithPitchAsASine) {
  const Values mean{0.2, -0.1, 0.0, 0.0};
  const Values record = record_of({{{0.0, 0.65}, flutter.shape}}, 96 * 6, mean);
  const auto periods = periods_of(section, {record, dtau});
  ASSERT_FALSE(periods.empty());
  EXPECT_NEAR(periods.back().period, pitch_period / 0.65, 1e-5);
  EXPECT_NEAR(periods.back().energy, settled_energy, 1e-5 * settled_energy);
  const Values sampled = sampled_period(section, {record, dtau}, periods.back(), 7);
  const Eigen::VectorXcd u = first_harmonic(section, TimeSpectral(3), sampled);
  EXPECT_NEAR(std::abs(u[1] - Complex(0.0, -0.01)), 0.0, 1e-7);
  // Where the phase is zero the pitch rises through its mean.
  const double begin = phase_at_begin(section, {record, dtau}, periods.back());
  EXPECT_NEAR(std::sin(begin), -1.0, 1e-6);
}

TEST(MarchVerdict, TellsGrowthDecayAndCycleApart) {
  MarchCriteria criteria;
  criteria.small_energy = 1.0;
  const auto verdict = [&](const Values& record) {
    return assess(section, {record, dtau}, criteria).verdict;
  };
  EXPECT_EQ(verdict(record_of({flutter, decaying}, 96 * 12)), MarchVerdict::grows);
  EXPECT_EQ(verdict(record_of({{{-0.02, 0.65}, flutter.shape}, decaying}, 96 * 12)), MarchVerdict::decays);
  EXPECT_EQ(verdict(settling_record(0.03, 0.8, 96 * 30)), MarchVerdict::limit_cycle);
  EXPECT_EQ(verdict(settling_record(0.03, 0.8, 96 * 3)), MarchVerdict::undecided);
}

// Great motion that shrinks may be on its way to a cycle.
TEST(MarchVerdict, DoesNotJudgeDecayFromGreatEnergy) {
  MarchCriteria criteria;
  criteria.small_energy = 1e-9;
  const Values record = record_of({{{-0.02, 0.65}, flutter.shape}}, 96 * 12);
  EXPECT_EQ(assess(section, {record, dtau}, criteria).verdict, MarchVerdict::undecided);
}

}  // namespace
}  // namespace wingbeat
