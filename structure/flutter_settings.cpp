#include "structure/flutter_settings.hpp"

namespace wingbeat {

void FlutterSettings::describe(SettingSection& keys) {
  keys.add("energy", &energy,
           {.help = "fluctuating energy E_0 of the cycle; small: the flutter boundary",
            .unit = "m b^2 omega_alpha^2",
            .range = above(0)});
  keys.add("reduced_frequency_range", &reduced_frequency_range,
           {.help = "omega b/U [lowest, highest] searched for the linear start", .range = above(0)});
  keys.add("samples", &samples,
           {.help = "reduced frequencies at which the linearised flow is solved", .range = between(4, 1000)});
  keys.add("roots", &roots,
           {.help = "lowest: the root at which rising speed first destabilises; all: every root that "
                    "destabilises, one after the other (what a sweep takes unless told otherwise)",
            .allowed = {"lowest", "all"}});
  keys.add_rule(
      "reduced_frequency_range", [this] { return reduced_frequency_range[0] < reduced_frequency_range[1]; },
      "the first must be below the second");
}

}  // namespace wingbeat
