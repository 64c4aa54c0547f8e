#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/io/settings.hpp"

namespace wingbeat {

// [pitch]: the pitch of the undeformed section, and the motion prescribed to it. Entry h - 1 of a list
// belongs to harmonic h.
struct PitchSettings {
  double mean_deg = 0.0;
  std::array<double, 2> axis{0.25, 0.0};
  std::optional<double> reduced_frequency;  // k = omega b/U
  double amplitude_deg = 0.0;               // added to the first of sine_deg
  std::vector<double> sine_deg, cosine_deg;
  std::vector<double> plunge_sine, plunge_cosine;  // h/b, positive down
  bool derivatives = false;
  double derivative_amplitude_deg = 0.1;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
