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
           {.help = "flux between cells. jst, matrix: central with scalar or matrix dissipation; cusp: "
                    "central with convective upwinding and split pressure; roe: approximate Riemann "
                    "solver; van_leer: flux-vector splitting",
            .allowed = {"jst", "matrix", "cusp", "roe", "van_leer"}});
  keys.add("limiter", &limiter,
           {.help = "of the states beside a face, for roe and van_leer",
            .allowed = {"van_albada", "venkatakrishnan"}});
  keys.add("entropy_fix", &entropy_fix,
           {.help = "for roe: share of the speed of sound below which an acoustic wave's speed is rounded "
                    "off; 0: none",
            .range = between(0, 1)});
  keys.add("jst_k2", &jst_k2, {.help = "coefficient of the second difference", .range = open_interval(0, 4)});
  keys.add("jst_k4", &jst_k4, {.help = "coefficient of the fourth difference", .range = open_interval(0, 1)});
  keys.add("jst_smoothing", &jst_smoothing,
           {.help = "width sigma of the smooth switches, of matrix too; 0: the classical scheme",
            .range = between(0, 10)});
  keys.add("matrix_k2", &matrix_k2,
           {.help = "coefficient of the second difference", .range = open_interval(0, 4)});
  keys.add("matrix_k4", &matrix_k4,
           {.help = "coefficient of the fourth difference", .range = open_interval(0, 1)});
  keys.add("matrix_acoustic_floor", &matrix_acoustic_floor,
           {.help = "least speed of acoustic waves as a share of the fastest's", .range = between(0, 1)});
  keys.add("matrix_linear_floor", &matrix_linear_floor,
           {.help = "least speed of entropy and shear waves as a share of the fastest wave's",
            .range = between(0, 1)});
  keys.add("moment_reference", &moment_reference,
           {.help = "point [x, y] of cm, moving with the section; unset: the elastic axis",
            .unit = "chords from the leading edge",
            .range = between(-1000, 1000)});
}

}  // namespace wingbeat
