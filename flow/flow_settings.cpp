#include "flow/flow_settings.hpp"

namespace wingbeat {

void FlowSettings::describe(SettingSection& keys) {
  keys.add("mach", &mach, {.help = "Mach number of the free stream", .range = between(0.05, 3)});
  keys.add("angle_of_attack_deg", &angle_of_attack_deg,
           {.help = "direction of the free stream; pitch.mean_deg turns the section instead",
            .unit = "deg",
            .range = between(-90, 90)});
  keys.add("gamma", &gamma, {.help = "ratio of specific heats", .range = open_interval(1, 2)});
  keys.add("scheme", &scheme,
           {.help = "jst: central flux with scalar Jameson-Schmidt-Turkel dissipation", .allowed = {"jst"}});
  keys.add("jst_k2", &jst_k2, {.help = "coefficient of the second difference", .range = open_interval(0, 4)});
  keys.add("jst_k4", &jst_k4, {.help = "coefficient of the fourth difference", .range = open_interval(0, 1)});
  keys.add("jst_smoothing", &jst_smoothing,
           {.help = "width sigma of the smooth switches; 0: the classical scheme", .range = between(0, 10)});
  keys.add("moment_reference", &moment_reference,
           {.help = "point [x, y] of cm, moving with the section; unset: the elastic axis",
            .unit = "chords from the leading edge",
            .range = between(-1000, 1000)});
}

}  // namespace wingbeat
