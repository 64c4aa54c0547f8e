#pragma once

#include <array>
#include <vector>

#include "core/io/settings.hpp"

namespace wingbeat {

// [flutter]: the amplitude at which the boundary is computed and where its linear start is sought.
struct FlutterSettings {
  double energy = 1e-6;  // E_0: fluctuating energy per period, in units of m b^2 omega_alpha^2
  std::array<double, 2> reduced_frequency_range{0.02, 0.6};
  int samples = 12;

  void describe(SettingSection& keys);
};

// [pk]: where frequency and damping are tabulated.
struct PkSettings {
  std::vector<double> reduced_velocities;
  std::array<double, 2> reduced_velocity_range{0.1, 5.0};
  int frequencies = 24;
  int samples = 50;

  // The given list, or the range at equal steps.
  std::vector<double> velocities() const;
  void describe(SettingSection& keys);
};

}  // namespace wingbeat
