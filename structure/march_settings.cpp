#include "structure/march_settings.hpp"

#include <numbers>

namespace wingbeat {

double MarchSettings::time_step() const { return 2.0 * std::numbers::pi / steps_per_period; }

void MarchSettings::describe(SettingSection& keys) {
  keys.add("reduced_velocity", &reduced_velocity,
           {.help = "speed V marched at; with --find-flutter the first guess; unset: that of --restart",
            .range = above(0)});
  keys.add(
      "steps_per_period", &steps_per_period,
      {.help = "time steps in 2 pi/omega_alpha, the period of uncoupled pitch", .range = between(8, 100000)});
  keys.add("order", &order,
           {.help = "order of the backward difference in time; 3 errs less in frequency, as much in growth",
            .range = between(2, 3)});
  keys.add("periods", &periods,
           {.help = "the most that is marched, in periods of uncoupled pitch", .range = above(0)});
  keys.add("tolerance", &tolerance,
           {.help = "of flow and structure in every step, relative to what changes in it",
            .range = open_interval(0, 0.1)});
  keys.add("until", &until,
           {.help = "ends with a verdict on growth or a limit cycle, only in a limit cycle or decay, or with "
                    "the time allowed",
            .allowed = {"verdict", "limit_cycle", "end"}});
  keys.add("growth_tolerance", &growth_tolerance,
           {.help = "error, relative to itself, at which a growth rate counts as known",
            .range = open_interval(0, 1)});
  keys.add("energy_tolerance", &energy_tolerance,
           {.help = "relative distance to a limit cycle's energy at which it counts as reached",
            .range = open_interval(0, 1)});
  keys.add("small_energy", &small_energy,
           {.help = "energy up to which growth and decay are those of small motion",
            .unit = "m b^2 omega_alpha^2",
            .range = above(0)});
  keys.add("velocity_tolerance", &velocity_tolerance,
           {.help = "relative error of the flutter speed that --find-flutter ends with",
            .range = open_interval(0, 0.1)});
  keys.add("snapshots", &snapshots,
           {.help = "phases of one more period at which surface.csv holds the pressure; 0: none",
            .range = between(0, 1000)});
  keys.add_rule(
      "snapshots", [this] { return snapshots <= steps_per_period; },
      "must not exceed march.steps_per_period: each takes a step of its own");
  keys.add("initial_plunge", &initial_plunge,
           {.help = "plunge beyond that of rest at the start", .unit = "semichords"});
  keys.add("initial_pitch_deg", &initial_pitch_deg,
           {.help = "pitch beyond that of rest at the start", .unit = "deg"});
  keys.add("initial_plunge_rate", &initial_plunge_rate,
           {.help = "plunge rate at the start", .unit = "b omega_alpha"});
  keys.add("initial_pitch_rate", &initial_pitch_rate,
           {.help = "pitch rate at the start; unset: that of the energy 1e-6 where all else is at rest",
            .unit = "omega_alpha"});
}

}  // namespace wingbeat
