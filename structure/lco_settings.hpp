#pragma once

#include <optional>
#include <vector>

#include "core/io/settings.hpp"

namespace wingbeat {

// [lco]: which limit cycles are computed.
struct LcoSettings {
  std::vector<double> energies;  // E_0 of the cycles, in units of m b^2 omega_alpha^2
  std::optional<double> reduced_velocity;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
