#include "structure/structure_settings.hpp"

namespace wingbeat {

void StructureSettings::describe(SettingSection& keys) {
  keys.add("elastic_axis", &elastic_axis,
           {.help = "a, elastic axis aft of mid-chord",
            .unit = "semichords",
            .range = between(-100, 100),
            .required = true});
  keys.add("static_unbalance", &static_unbalance,
           {.help = "x_alpha, centre of gravity aft of the elastic axis",
            .unit = "semichords",
            .range = between(-100, 100),
            .required = true});
  keys.add("gyration_radius_squared", &gyration_radius_squared,
           {.help = "r_alpha^2, radius of gyration about the elastic axis, squared",
            .unit = "semichords^2",
            .range = above(0),
            .required = true});
  keys.add("frequency_ratio", &frequency_ratio,
           {.help = "omega_h/omega_alpha, uncoupled plunge over pitch frequency",
            .range = above(0),
            .required = true});
  keys.add("mass_ratio", &mass_ratio, {.help = "mu = m/(pi rho b^2)", .range = above(0), .required = true});
  keys.add("damping", &damping,
           {.help = "fraction of critical damping of the two in-vacuo modes, lower frequency first",
            .range = between(0, 1)});
  keys.add_rule(
      "gyration_radius_squared",
      [this] { return gyration_radius_squared > static_unbalance * static_unbalance; },
      "must exceed structure.static_unbalance squared, or the mass matrix is not positive definite");
}

}  // namespace wingbeat
