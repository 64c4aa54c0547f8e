#include "flow/forced_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

constexpr double semichord = 0.5;  // in chords
constexpr double radian = std::numbers::pi / 180.0;

Complex entry(const std::vector<Complex>& amplitudes, int h) {
  return h <= static_cast<int>(amplitudes.size()) ? amplitudes[static_cast<std::size_t>(h - 1)] : 0.0;
}

// S sin h theta + C cos h theta = Re((C - i S) e^{i h theta}).
std::vector<Complex> amplitudes(std::span<const double> sines, std::span<const double> cosines, double unit) {
  std::vector<Complex> result(std::max(sines.size(), cosines.size()));
  for (std::size_t j = 0; j < sines.size(); ++j) result[j] -= Complex(0.0, unit * sines[j]);
  for (std::size_t j = 0; j < cosines.size(); ++j) result[j] += unit * cosines[j];
  return result;
}

}  // namespace

int ForcedMotion::harmonics() const {
  int h = static_cast<int>(std::max(pitch.size(), plunge.size()));
  while (h > 0 && pitch_harmonic(h) == 0.0 && plunge_harmonic(h) == 0.0) --h;
  return h;
}

Complex ForcedMotion::pitch_harmonic(int h) const { return entry(pitch, h); }
Complex ForcedMotion::plunge_harmonic(int h) const { return entry(plunge, h); }

ForcedPosition position_at(const ForcedMotion& motion, double phase) {
  ForcedPosition position{.pitch = motion.mean_pitch};
  for (int h = 1; h <= motion.harmonics(); ++h) {
    const Complex turn = std::polar(1.0, h * phase), slope(0.0, h);
    const Complex pitch = motion.pitch_harmonic(h) * turn, plunge = motion.plunge_harmonic(h) * turn;
    position.pitch += pitch.real();
    position.plunge += plunge.real();
    position.pitch_slope += (slope * pitch).real();
    position.plunge_slope += (slope * plunge).real();
  }
  return position;
}

std::vector<MotionState> motions_of(const ForcedMotion& motion, const TimeSpectral& time, double kappa) {
  std::vector<MotionState> states;
  for (int n = 0; n < time.instances(); ++n) {
    const ForcedPosition at = position_at(motion, time.phase(n));
    states.push_back({at.pitch, kappa * at.pitch_slope, kappa * at.plunge_slope});
  }
  return states;
}

ForcedMotion forced_motion(const PitchSettings& settings) {
  std::vector<double> sines = settings.sine_deg;
  if (sines.empty()) sines.push_back(0.0);
  sines[0] += settings.amplitude_deg;
  ForcedMotion motion;
  motion.mean_pitch = radian * settings.mean_deg;
  motion.pitch = amplitudes(sines, settings.cosine_deg, radian);
  motion.plunge = amplitudes(settings.plunge_sine, settings.plunge_cosine, semichord);
  return motion;
}

}  // namespace wingbeat
