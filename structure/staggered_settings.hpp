#pragma once

#include "core/io/settings.hpp"
#include "structure/staggered.hpp"

namespace wingbeat {

// [staggered]: how flow and structure take turns.
struct StaggeredSettings {
  int flow_cycles = 5;
  int frequency_interval = 1;
  double pseudo_time_step = 1.0;
  double relaxation = 1.0;
  int max_iterations = 5000;
  int max_recoveries = 6;

  StaggeredOptions options(const AeroelasticTolerances& tolerances) const;
  void describe(SettingSection& keys);
};

}  // namespace wingbeat
