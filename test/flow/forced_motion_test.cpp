#include "flow/forced_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace wingbeat {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

PitchSettings several_harmonics() {
  PitchSettings settings;
  settings.mean_deg = 2.0;
  settings.amplitude_deg = 1.0;
  settings.sine_deg = {0.5, -0.3};
  settings.cosine_deg = {0.2, 0.0, 0.4};
  settings.plunge_sine = {0.0, 0.06};
  settings.plunge_cosine = {0.1};
  return settings;
}

TEST(ForcedMotion, IsTheSeriesOfTheCase) {
  const ForcedMotion motion = forced_motion(several_harmonics());
  EXPECT_EQ(motion.harmonics(), 3);
  for (double theta : {0.0, 0.7, 2.9, 5.5}) {
    const ForcedPosition at = position_at(motion, theta);
    EXPECT_NEAR(at.pitch,
                degree * (2.0 + 1.5 * std::sin(theta) - 0.3 * std::sin(2 * theta) + 0.2 * std::cos(theta) +
                          0.4 * std::cos(3 * theta)),
                1e-15);
    // Half a chord is a semichord.
    EXPECT_NEAR(at.plunge, 0.5 * (0.06 * std::sin(2 * theta) + 0.1 * std::cos(theta)), 1e-15);
  }
}

TEST(ForcedMotion, RatesAreTheSpectralDerivativeOfThePositions) {
  const ForcedMotion motion = forced_motion(several_harmonics());
  const double kappa = 0.37;
  const TimeSpectral time(3);
  std::vector<double> pitch, plunge, pitch_rate(7, 0.0), plunge_rate(7, 0.0);
  for (int n = 0; n < time.instances(); ++n) {
    pitch.push_back(position_at(motion, time.phase(n)).pitch);
    plunge.push_back(position_at(motion, time.phase(n)).plunge);
  }
  time.add_derivative(kappa, pitch, pitch_rate);
  time.add_derivative(kappa, plunge, plunge_rate);
  const auto states = motions_of(motion, time, kappa);
  ASSERT_EQ(states.size(), 7U);
  for (std::size_t n = 0; n < states.size(); ++n) {
    EXPECT_EQ(states[n].pitch, pitch[n]) << "the mean belongs to it";
    EXPECT_NEAR(states[n].pitch_rate, pitch_rate[n], 1e-15);
    EXPECT_NEAR(states[n].plunge_rate, plunge_rate[n], 1e-15);
  }
}

TEST(ForcedMotion, AnAmplitudeIsASineOfTheFirstHarmonic) {
  PitchSettings settings;
  settings.amplitude_deg = 1.01;
  const ForcedMotion motion = forced_motion(settings);
  EXPECT_EQ(motion.pitch_harmonic(1), std::complex<double>(0.0, -1.01 * degree));
  EXPECT_EQ(motion.harmonics(), 1);
}

TEST(ForcedMotion, WithoutAmplitudesIsRest) {
  PitchSettings settings;
  settings.mean_deg = 3.0;
  settings.sine_deg = {0.0, 0.0};
  const ForcedMotion motion = forced_motion(settings);
  EXPECT_EQ(motion.harmonics(), 0);
  const auto states = motions_of(motion, TimeSpectral(1), 0.5);
  for (const MotionState& state : states) {
    EXPECT_EQ(state.pitch, 3.0 * degree);
    EXPECT_EQ(state.pitch_rate, 0.0);
  }
}

}  // namespace
}  // namespace wingbeat
