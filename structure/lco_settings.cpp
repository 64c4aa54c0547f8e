#include "structure/lco_settings.hpp"

#include <cmath>

namespace wingbeat {

std::vector<double> LcoSettings::all_energies() const {
  std::vector<double> all = energies;
  if (!energy_range) return all;
  const double first = std::sqrt((*energy_range)[0]), last = std::sqrt((*energy_range)[1]);
  for (int i = 0; i < samples; ++i) all.push_back(std::pow(first + (last - first) * i / (samples - 1), 2));
  return all;
}

void LcoSettings::describe(SettingSection& keys) {
  const std::string unit = "m b^2 omega_alpha^2";
  keys.add("energies", &energies,
           {.help = "fluctuating energies E_0 at which limit cycles are computed, one after the other",
            .unit = unit,
            .range = above(0)});
  keys.add("energy_range", &energy_range,
           {.help = "E_0 [first, last] of further cycles, at equal steps of their amplitude",
            .unit = unit,
            .range = above(0)});
  keys.add("samples", &samples, {.help = "cycles over energy_range", .range = between(2, 10000)});
  keys.add(
      "reduced_velocity", &reduced_velocity,
      {.help = "speed V at which a limit cycle is computed: the first of the branch, which is followed to "
               "max_energy for it",
       .range = above(0)});
  keys.add("all_crossings", &all_crossings,
           {.help = "with a coupled method: go on to max_energy and compute every cycle of that speed, on "
                    "both sides of a fold"});
  keys.add("max_energy", &max_energy,
           {.help = "E_0 up to which the branch is followed in search of reduced_velocity",
            .unit = unit,
            .range = above(0)});
  keys.add("step", &step,
           {.help = "first step along the branch, as a part of the largest amplitude asked for; later ones "
                    "follow from the Newton iterations taken",
            .range = open_interval(0, 1)});
  keys.add("harmonic_share", &harmonic_share,
           {.help = "a harmonic is added to time.harmonics where the highest one carries more than this part "
                    "of the energy; unset: none is",
            .range = open_interval(0, 1)});
  keys.add("max_harmonics", &max_harmonics,
           {.help = "harmonics that harmonic_share may lead to", .range = between(1, 100)});
}

}  // namespace wingbeat
