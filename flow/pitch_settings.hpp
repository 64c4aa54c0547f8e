#pragma once

#include <array>

#include "core/io/settings.hpp"

namespace wingbeat {

// [pitch]: the section's prescribed pitch, mean + amplitude sin(theta) about an axis.
struct PitchSettings {
  double mean_deg = 0.0;
  double amplitude_deg = 1.0;
  double reduced_frequency = 0.2;  // omega b / U, on the semichord
  std::array<double, 2> axis{0.25, 0.0};

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
