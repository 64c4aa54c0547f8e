#include "flow/pitch_settings.hpp"

namespace wingbeat {

void PitchSettings::describe(SettingSection& keys) {
  keys.add("mean_deg", &mean_deg,
           {.help = "pitch of the undeformed section, nose-up", .unit = "deg", .range = between(-90, 90)});
  keys.add("axis", &axis,
           {.help = "axis [x, y] that the section pitches about; with [structure], the elastic axis serves",
            .unit = "chords from the leading edge",
            .range = between(-1000, 1000)});
  keys.add("reduced_frequency", &reduced_frequency,
           {.help = "k = omega b/U of the prescribed motion, on the semichord; needed by pitch",
            .range = above(0)});
  keys.add("amplitude_deg", &amplitude_deg,
           {.help = "prescribed pitch: sine of the first harmonic, nose-up",
            .unit = "deg",
            .range = between(-90, 90)});
  keys.add("sine_deg", &sine_deg,
           {.help = "prescribed pitch: sines of harmonics 1, 2, ...; adds to amplitude_deg",
            .unit = "deg",
            .range = between(-90, 90)});
  keys.add(
      "cosine_deg", &cosine_deg,
      {.help = "prescribed pitch: cosines of harmonics 1, 2, ...", .unit = "deg", .range = between(-90, 90)});
  keys.add("plunge_sine", &plunge_sine,
           {.help = "prescribed plunge h/b, positive down: sines of harmonics 1, 2, ...",
            .unit = "semichords",
            .range = between(-1000, 1000)});
  keys.add("plunge_cosine", &plunge_cosine,
           {.help = "prescribed plunge h/b, positive down: cosines of harmonics 1, 2, ...",
            .unit = "semichords",
            .range = between(-1000, 1000)});
  keys.add("derivatives", &derivatives,
           {.help = "also compute Q(k) from small forced pitch and plunge, beside the linearised one"});
  keys.add("derivative_amplitude_deg", &derivative_amplitude_deg,
           {.help = "pitch of that small motion; plunge is made to incline the stream as much",
            .unit = "deg",
            .range = open_interval(0, 90)});
}

}  // namespace wingbeat
