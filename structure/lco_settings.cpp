#include "structure/lco_settings.hpp"

namespace wingbeat {

void LcoSettings::describe(SettingSection& keys) {
  keys.add("energies", &energies,
           {.help = "fluctuating energies E_0 at which limit cycles are computed, one after the other",
            .unit = "m b^2 omega_alpha^2",
            .range = above(0)});
  keys.add("reduced_velocity", &reduced_velocity,
           {.help = "speed V at which a limit cycle is computed; its energy is found from lco.energies' last "
                    "value, or flutter.energy",
            .range = above(0)});
}

}  // namespace wingbeat
