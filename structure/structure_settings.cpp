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
  keys.add("plunge_cubic", &plunge_cubic,
           {.help = "plunge spring: plunge_cubic (h/b)^3 beside the linear (omega_h/omega_alpha)^2 h/b"});
  keys.add("plunge_quintic", &plunge_quintic, {.help = "plunge spring: plunge_quintic (h/b)^5 is added"});
  keys.add(
      "pitch_cubic", &pitch_cubic,
      {.help = "pitch spring: pitch_cubic alpha^3, alpha in radians, beside the linear r_alpha^2 alpha"});
  keys.add("pitch_quintic", &pitch_quintic,
           {.help = "pitch spring: pitch_quintic alpha^5, alpha in radians, is added"});
  keys.add("plunge_freeplay", &plunge_freeplay,
           {.help = "half the dead zone of the linear plunge spring; linear flutter and pk go without it, as "
                    "large motion would",
            .unit = "semichords",
            .range = at_least(0)});
  keys.add("pitch_freeplay_deg", &pitch_freeplay_deg,
           {.help = "half the dead zone of the linear pitch spring; linear flutter and pk go without it, as "
                    "large motion would",
            .unit = "deg",
            .range = between(0, 90)});
  keys.add("freeplay_smoothing", &freeplay_smoothing,
           {.help = "how far the corners of the dead zones are rounded, over their half widths",
            .range = between(1e-3, 1)});
  keys.add_rule(
      "gyration_radius_squared",
      [this] { return gyration_radius_squared > static_unbalance * static_unbalance; },
      "must exceed structure.static_unbalance squared, or the mass matrix is not positive definite");
}

}  // namespace wingbeat
