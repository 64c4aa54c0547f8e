#pragma once

#include <complex>
#include <vector>

#include "core/spectral/time_spectral.hpp"
#include "flow/motion.hpp"
#include "flow/pitch_settings.hpp"

namespace wingbeat {

// Motion prescribed over a period (eq:forced-motion), harmonic h at [h - 1]:
//   alpha(theta) = mean_pitch + Re sum_h pitch_h e^{i h theta},   h(theta) = Re sum_h plunge_h e^{i h theta},
// alpha in radians nose up, h in chords positive down.
struct ForcedMotion {
  double mean_pitch = 0.0;
  std::vector<std::complex<double>> pitch;
  std::vector<std::complex<double>> plunge;

  // The highest harmonic that moves; 0 at rest.
  int harmonics() const;
  // Amplitudes of harmonic h >= 1; zero beyond those given.
  std::complex<double> pitch_harmonic(int h) const;
  std::complex<double> plunge_harmonic(int h) const;
};

// The position at one phase and its rates with respect to the phase.
struct ForcedPosition {
  double pitch = 0.0;   // with the mean
  double plunge = 0.0;  // chords
  double pitch_slope = 0.0;
  double plunge_slope = 0.0;
};
ForcedPosition position_at(const ForcedMotion& motion, double phase);

// The motion of every instance at frequency kappa on the flow's clock; rates are exact.
std::vector<MotionState> motions_of(const ForcedMotion& motion, const TimeSpectral& time, double kappa);

// The motion that a case prescribes.
ForcedMotion forced_motion(const PitchSettings& settings);

}  // namespace wingbeat
