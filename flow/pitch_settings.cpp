#include "flow/pitch_settings.hpp"

namespace wingbeat {

void PitchSettings::describe(SettingSection& keys) {
  keys.add("mean_deg", &mean_deg,
           {.help = "pitch of the undeformed section, nose-up", .unit = "deg", .range = between(-90, 90)});
  keys.add(
      "axis", &axis,
      {.help = "axis [x, y] that mean_deg turns the section about; with [structure], the elastic axis serves",
       .unit = "chords from the leading edge",
       .range = between(-1000, 1000)});
}

}  // namespace wingbeat
