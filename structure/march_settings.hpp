#pragma once

#include <optional>
#include <string>

#include "core/io/settings.hpp"

namespace wingbeat {

// [march]: a time-accurate march of flow and structure, and when it ends.
struct MarchSettings {
  std::optional<double> reduced_velocity;
  int steps_per_period = 96;  // of uncoupled pitch, 2 pi/omega_alpha
  int order = 2;
  double periods = 60.0;  // the longest march, in periods of uncoupled pitch
  double tolerance = 1e-4;
  std::string until = "verdict";
  double growth_tolerance = 0.02;
  double energy_tolerance = 1e-3;
  double small_energy = 1e-4;
  double velocity_tolerance = 1e-4;
  int snapshots = 8;
  double initial_plunge = 0.0;
  double initial_pitch_deg = 0.0;
  double initial_plunge_rate = 0.0;
  std::optional<double> initial_pitch_rate;

  double time_step() const;  // in 1/omega_alpha
  void describe(SettingSection& keys);
};

}  // namespace wingbeat
