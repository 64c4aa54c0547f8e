#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/settings.hpp"

namespace wingbeat {

// [sweep]: a verb run at many points, which keys change from point to point, and how the points are solved.
struct SweepSettings {
  std::string verb = "flutter";
  std::vector<std::string> parameters{};
  std::string combine = "grid";
  std::optional<std::string> table{};
  bool continuation = true;
  int groups = 1;
  int refine = 0;
  double refine_tolerance = 0.01;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
