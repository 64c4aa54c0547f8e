#include "structure/conditions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/io/error.hpp"
#include "structure/energy.hpp"
#include "structure/harmonic_motion.hpp"
#include "structure/typical_section.hpp"

namespace wingbeat {
namespace {

using Values = std::vector<double>;
using Complex = std::complex<double>;

StructureModel section() { return structure_model({-0.6, .25, .75, .5, 75.0}); }

Values arbitrary(std::size_t size) {
  Values v(size);
  for (std::size_t i = 0; i < size; ++i) v[i] = 0.4 + std::sin(0.5 + 1.7 * static_cast<double>(i));
  return v;
}

// A motion with a mean and harmonics 1 to N_H.
Values arbitrary(const TimeSpectral& time) {
  return arbitrary(static_cast<std::size_t>(4 * time.instances()));
}

void expect_gradient(const AmplitudeCondition& condition, const Values& y) {
  Values gradient(y.size(), 0.0);
  add_gradient(condition, y, 1.0, gradient);
  for (std::size_t i = 0; i < y.size(); ++i) {
    Values above = y, below = y;
    above[i] += 0.5;
    below[i] -= 0.5;
    // Quadratic at most: the central difference is exact.
    EXPECT_NEAR(gradient[i], value(condition, above) - value(condition, below), 1e-12) << "entry " << i;
  }
}

TEST(Energy, HarmonicsShareTheAverageEnergy) {
  for (const int harmonics : {1, 2, 5}) {
    const TimeSpectral time(harmonics);
    const Values y = arbitrary(time);
    const Values share = harmonic_energies(section(), time, y);
    const double total = average_energy(section(), y);
    EXPECT_NEAR(std::accumulate(share.begin(), share.end(), 0.0), total, 1e-14 * total);
    EXPECT_NEAR(std::accumulate(share.begin() + 1, share.end(), 0.0), fluctuating_energy(section(), y),
                1e-14 * total);
    EXPECT_GT(share[0], 0.01 * total);
  }
}

TEST(Energy, OfASineIsThatOfItsAmplitude) {
  // Pitch A sin theta at frequency omega: (1/4) r_alpha^2 A^2 (1 + omega^2).
  const TimeSpectral time(3);
  const double a = 0.1, omega = 0.65;
  const Values y = harmonic_states(section(), time, Eigen::Vector2cd(0.0, Complex(0.0, -a)), omega);
  EXPECT_NEAR(average_energy(section(), y), 0.25 * 0.75 * a * a * (1.0 + omega * omega), 1e-16);
  EXPECT_NEAR(fluctuating_energy(section(), y), average_energy(section(), y), 1e-16);
}

TEST(Energy, FluctuationIgnoresTheMean) {
  const TimeSpectral time(2);
  Values y = arbitrary(time);
  const double before = fluctuating_energy(section(), y);
  for (std::size_t i = 1; i < y.size(); i += 4) y[i] += 3.0;
  EXPECT_NEAR(fluctuating_energy(section(), y), before, 1e-13 * before);
  EXPECT_GT(average_energy(section(), y), 2.0 * before);
}

TEST(Energy, AverageGradientIsExact) {
  const Values y = arbitrary(TimeSpectral(1));
  Values gradient(y.size(), 0.0);
  add_average_energy_gradient(section(), y, 2.0, gradient);
  for (std::size_t i = 0; i < y.size(); ++i) {
    Values above = y, below = y;
    above[i] += 0.5;
    below[i] -= 0.5;
    EXPECT_NEAR(gradient[i], 2.0 * (average_energy(section(), above) - average_energy(section(), below)),
                1e-14);
  }
}

TEST(Conditions, GradientsAreExact) {
  const TimeSpectral time(2);
  const Values y = arbitrary(time);
  expect_gradient(energy_condition(section(), 0.3), y);
  expect_gradient(first_harmonic_condition(section(), time, pitch_mode, 0.2), y);
  expect_gradient(phase_condition(section(), time), y);
}

TEST(Conditions, ReadTheFirstHarmonicOfTheirModeAlone) {
  const TimeSpectral time(3);
  const StructureModel model = section();
  // Plunge at another phase, a mean and higher harmonics in pitch: none of them counts.
  Values y = harmonic_states(model, time, Eigen::Vector2cd(Complex(0.3, 0.2), Complex(0.07, -0.2)), 0.65);
  for (int n = 0; n < time.instances(); ++n)
    y[static_cast<std::size_t>(4 * n + pitch_mode)] +=
        0.5 + 0.3 * std::cos(2.0 * time.phase(n)) - 0.1 * std::sin(3.0 * time.phase(n));
  EXPECT_NEAR(value(phase_condition(model, time), y), 0.07, 1e-15);
  EXPECT_NEAR(value(first_harmonic_condition(model, time, pitch_mode, 0.2), y), 0.0, 1e-15);
  EXPECT_NEAR(value(first_harmonic_condition(model, time, pitch_mode, 0.1), y), 1.0, 1e-14);
  const Eigen::VectorXcd first = first_harmonic(model, time, y);
  EXPECT_LT((first - Eigen::Vector2cd(Complex(0.3, 0.2), Complex(0.07, -0.2))).norm(), 1e-15);
}

TEST(HarmonicMotion, ScaledModeMeetsPhaseAndEnergy) {
  const TimeSpectral time(2);
  const StructureModel model = section();
  const double omega = 0.65, energy = 1e-6;
  const Eigen::VectorXcd mode =
      scaled_to_energy(model, Eigen::Vector2cd(Complex(0.3, 0.8), Complex(-0.5, 0.1)), omega, energy);
  const Values y = harmonic_states(model, time, mode, omega);
  EXPECT_NEAR(value(phase_condition(model, time), y), 0.0, 1e-18);
  EXPECT_NEAR(value(energy_condition(model, energy), y), 0.0, 1e-14);
  EXPECT_LT(mode[pitch_mode].imag(), 0.0);  // a sine of positive amplitude
  EXPECT_THROW(scaled_to_energy(model, Eigen::Vector2cd(1.0, 0.0), omega, energy), InputError);
}

TEST(Conditions, RefuseAmplitudesThatAreNotPositive) {
  EXPECT_THROW(energy_condition(section(), 0.0), InputError);
  EXPECT_THROW(first_harmonic_condition(section(), TimeSpectral(1), pitch_mode, -0.1), InputError);
  EXPECT_THROW(first_harmonic_condition(section(), TimeSpectral(1), 2, 0.1), InputError);
}

}  // namespace
}  // namespace wingbeat
