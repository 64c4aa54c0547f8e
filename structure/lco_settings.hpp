#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/io/settings.hpp"

namespace wingbeat {

// [lco]: which limit cycles are computed.
struct LcoSettings {
  std::vector<double> energies;  // E_0 of the cycles, in units of m b^2 omega_alpha^2
  std::optional<std::array<double, 2>> energy_range;
  int samples = 10;
  std::optional<double> reduced_velocity;
  bool all_crossings = false;
  double max_energy = 0.05;
  double step = 0.15;
  std::optional<double> harmonic_share;
  int max_harmonics = 8;

  // Those listed, then those of the range: equal steps in amplitude.
  std::vector<double> all_energies() const;
  void describe(SettingSection& keys);
};

}  // namespace wingbeat
