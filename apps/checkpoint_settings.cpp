#include "apps/checkpoint_settings.hpp"

namespace wingbeat {

void CheckpointSettings::describe(SettingSection& keys) {
  keys.add("interval", &interval,
           {.help = "time between two checkpoints, after which the next iteration or time step writes "
                    "solution.cgns; 0: none but those of stages and of the end",
            .unit = "s",
            .range = at_least(0.0)});
  keys.add("largest_share", &largest_share,
           {.help = "of the run's time, the most that checkpoints may take: where writing is slow they come "
                    "more rarely than the interval; 1: no limit",
            .range = {.lower = 0.0, .upper = 1.0, .lower_open = true}});
}

}  // namespace wingbeat
