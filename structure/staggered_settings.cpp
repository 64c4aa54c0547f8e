#include "structure/staggered_settings.hpp"

namespace wingbeat {

StaggeredOptions StaggeredSettings::options(const AeroelasticTolerances& tolerances) const {
  return {.flow_cycles = flow_cycles,
          .frequency_interval = frequency_interval,
          .pseudo_time_step = pseudo_time_step,
          .relaxation = relaxation,
          .max_iterations = max_iterations,
          .max_recoveries = max_recoveries,
          .tolerances = tolerances};
}

void StaggeredSettings::describe(SettingSection& keys) {
  keys.add("flow_cycles", &flow_cycles,
           {.help = "cycles of the flow solver between two structural steps", .range = between(1, 10000)});
  keys.add(
      "frequency_interval", &frequency_interval,
      {.help = "structural steps between two updates of frequency and speed", .range = between(1, 10000)});
  keys.add("pseudo_time_step", &pseudo_time_step,
           {.help = "implicit pseudo-time step of the structure", .unit = "periods", .range = above(0)});
  keys.add("relaxation", &relaxation,
           {.help = "share of every structural step that is taken",
            .range = {.lower = 0.0, .upper = 1.0, .lower_open = true}});
  keys.add("max_iterations", &max_iterations,
           {.help = "structural steps allowed", .range = between(1, 1000000)});
  keys.add("max_recoveries", &max_recoveries,
           {.help = "times the iteration may go back to its best state, with half the relaxation",
            .range = between(0, 100)});
}

}  // namespace wingbeat
