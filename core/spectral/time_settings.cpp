#include "core/spectral/time_settings.hpp"

namespace wingbeat {

void TimeSettings::describe(SettingSection& keys) {
  keys.add("harmonics", &harmonics,
           {.help = "harmonics N_H kept of a period; it is computed at 2 N_H + 1 instances",
            .range = between(1, 32)});
}

}  // namespace wingbeat
