#pragma once

#include <array>

#include "core/io/settings.hpp"

namespace wingbeat {

// [pitch]: the pitch of the undeformed section.
struct PitchSettings {
  double mean_deg = 0.0;
  std::array<double, 2> axis{0.25, 0.0};

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
