#pragma once

#include <string>
#include <vector>

#include "core/io/settings.hpp"

namespace wingbeat {

// [gradient]: of what, and with respect to what.
struct GradientSettings {
  std::string objective = "flutter_speed";
  std::vector<std::string> parameters{"bumps"};
  std::string analysis = "steady";  // that loads are of
  int harmonic = 0;
  std::string part = "real";
  bool fixed_lift = false;
  double tolerance = 1e-10;
  double onset_energy = 1e-4;
  double difference_step = 5e-4;
  int max_differences = 32;

  bool has(const std::string& parameter) const;
  bool is_of_loads() const;
  bool is_of_given_speed() const;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
