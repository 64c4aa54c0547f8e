#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/settings.hpp"

namespace wingbeat {

// [optimize]: what is optimised, by which variables, and how.
struct OptimizeSettings {
  std::optional<std::string> problem{};
  std::optional<std::string> objective{};
  std::vector<std::string> constraints{};
  std::vector<std::string> monitor{};
  std::vector<std::string> variables{"bumps"};
  double angle_bound_deg = 2.0;
  std::vector<double> start{};
  int max_iterations = 100;
  double tolerance = 1e-4;
  std::vector<std::string> ipopt{};
  int groups = 1;
  double sharpness = 100.0;
  std::vector<std::string> compare{"steady", "flutter"};
  double root_margin = 0.05;
  int max_bisections = 1;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
