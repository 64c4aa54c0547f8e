#include "structure/flutter_settings.hpp"

#include <algorithm>
#include <functional>

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
  keys.add_rule(
      "reduced_frequency_range", [this] { return reduced_frequency_range[0] < reduced_frequency_range[1]; },
      "the first must be below the second");
}

std::vector<double> PkSettings::velocities() const {
  if (!reduced_velocities.empty()) return reduced_velocities;
  const auto [first, last] = reduced_velocity_range;
  std::vector<double> velocities;
  for (int i = 0; i < samples; ++i) velocities.push_back(first + (last - first) * i / (samples - 1));
  return velocities;
}

void PkSettings::describe(SettingSection& keys) {
  keys.add("reduced_velocities", &reduced_velocities,
           {.help = "V = U/(c omega_alpha) of the table, rising; empty: the range below", .range = above(0)});
  keys.add("reduced_velocity_range", &reduced_velocity_range,
           {.help = "V [first, last] of the table", .range = above(0)});
  keys.add("frequencies", &frequencies,
           {.help = "reduced frequencies at which Q(k) is computed, over flutter.reduced_frequency_range",
            .range = between(4, 1000)});
  keys.add("samples", &samples, {.help = "rows of the table over the range", .range = between(2, 100000)});
  keys.add_rule(
      "reduced_velocities",
      [this] {
        return std::ranges::adjacent_find(reduced_velocities, std::greater_equal()) ==
               reduced_velocities.end();
      },
      "must rise, so that the branches can be followed");
  keys.add_rule(
      "reduced_velocity_range", [this] { return reduced_velocity_range[0] < reduced_velocity_range[1]; },
      "the first must be below the second");
}

}  // namespace wingbeat
