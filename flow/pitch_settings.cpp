#include "flow/pitch_settings.hpp"

namespace wingbeat {

void PitchSettings::describe(SettingSection& keys) {
  keys.add("mean_deg", &mean_deg,
           {.help = "pitch of the undeformed section, nose-up", .unit = "deg", .range = between(-90, 90)});
  keys.add("amplitude_deg", &amplitude_deg,
           {.help = "amplitude of the prescribed pitch", .unit = "deg", .range = between(0, 90)});
  keys.add("reduced_frequency", &reduced_frequency,
           {.help = "omega b/U of the prescribed pitch, b the semichord", .range = open_interval(0, 100)});
  keys.add("axis", &axis,
           {.help = "axis [x, y] of the prescribed pitch",
            .unit = "chords from the leading edge",
            .range = between(-1000, 1000)});
}

}  // namespace wingbeat
