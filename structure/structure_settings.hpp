#pragma once

#include <array>

#include "core/io/settings.hpp"

namespace wingbeat {

// [structure]: the pitch-plunge section, in semichords and 1/omega_alpha.
struct StructureSettings {
  double elastic_axis = 0.0;             // a, aft of mid-chord
  double static_unbalance = 0.0;         // x_alpha, centre of gravity aft of the elastic axis
  double gyration_radius_squared = 0.0;  // r_alpha^2, about the elastic axis
  double frequency_ratio = 0.0;          // omega_h / omega_alpha
  double mass_ratio = 0.0;               // m / (pi rho b^2)
  std::array<double, 2> damping{0.0, 0.0};
  double plunge_cubic = 0.0, plunge_quintic = 0.0;
  double pitch_cubic = 0.0, pitch_quintic = 0.0;
  double plunge_freeplay = 0.0;     // semichords
  double pitch_freeplay_deg = 0.0;  // degrees
  double freeplay_smoothing = 0.1;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
