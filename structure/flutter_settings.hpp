#pragma once

#include <array>
#include <string>

#include "core/io/settings.hpp"

namespace wingbeat {

// [flutter]: the amplitude at which the boundary is computed and where its linear start is sought.
struct FlutterSettings {
  double energy = 1e-6;  // E_0: fluctuating energy per period, in units of m b^2 omega_alpha^2
  std::array<double, 2> reduced_frequency_range{0.02, 0.6};
  int samples = 12;
  std::string roots = "lowest";

  bool wants_all_roots() const { return roots == "all"; }

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
