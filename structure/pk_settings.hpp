#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/io/settings.hpp"

namespace wingbeat {

// [pk]: where Q(k) comes from, and where frequency and damping are tabulated.
struct PkSettings {
  std::string aerodynamics = "linearized";
  std::optional<std::string> table_file;
  std::vector<double> reduced_velocities;
  std::array<double, 2> reduced_velocity_range{0.1, 5.0};
  int frequencies = 24;
  int samples = 50;

  bool reads_table() const { return aerodynamics == "table"; }
  // The given list, or the range at equal steps.
  std::vector<double> velocities() const;
  void describe(SettingSection& keys);
};

}  // namespace wingbeat
