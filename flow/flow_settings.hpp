#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/io/settings.hpp"

namespace wingbeat {

// [flow]: the free stream, the gas and the scheme.
struct FlowSettings {
  double mach = 0.8;
  double angle_of_attack_deg = 0.0;  // turns the free stream, not the section
  double gamma = 1.4;
  std::string scheme = "jst";
  std::string limiter = "van_albada";
  double entropy_fix = 0.1;
  double jst_k2 = 0.25;
  double jst_k4 = 1.0 / 64.0;
  double jst_smoothing = 1.0;
  double matrix_k2 = 0.5;
  double matrix_k4 = 1.0 / 64.0;
  double matrix_acoustic_floor = 0.25;
  double matrix_linear_floor = 0.025;
  std::optional<std::array<double, 2>> moment_reference;  // the elastic axis when empty

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
