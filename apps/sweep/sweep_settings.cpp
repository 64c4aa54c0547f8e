#include "apps/sweep/sweep_settings.hpp"

namespace wingbeat {

void SweepSettings::describe(SettingSection& keys) {
  keys.add("verb", &verb,
           {.help = "what is run at each point",
            .allowed = {"steady", "pitch", "flutter", "lco", "march", "pk", "gradient"}});
  keys.add(
      "parameters", &parameters,
      {.help = "each \"KEY = VALUES\", KEY any section.key: a list, \"flow.mach = [0.7, 0.75, 0.8]\", or "
               "a range, \"flow.mach = 0.7 to 0.9 step 0.01\" or \"flow.mach = 0.7 to 0.9 in 21\""});
  keys.add("combine", &combine,
           {.help = "grid: every value with every value of the others; zip: the first of each, the second of "
                    "each, ...",
            .allowed = {"grid", "zip"}});
  keys.add(
      "table", &table,
      {.help = "points as a table, in place of parameters: the first line names the keys, each other line "
               "is a point, separated by commas",
       .path = PathRule::file});
  keys.add("continuation", &continuation,
           {.help = "points start from the nearest one finished; false: each on its own"});
  keys.add("groups", &groups,
           {.help = "groups of ranks that take points from one queue; --groups", .range = at_least(1)});
  keys.add("refine", &refine,
           {.help = "points added at most, halfway between others, where the curve of the first result bends "
                    "or ends; one parameter that is a number",
            .range = between(0, 100000)});
  keys.add("refine_tolerance", &refine_tolerance,
           {.help = "bend that is left alone: departure from the straight line between the neighbours, as a "
                    "part of the range of the results",
            .range = open_interval(0, 1)});
}

}  // namespace wingbeat
