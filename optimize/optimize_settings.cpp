#include "optimize/optimize_settings.hpp"

#include "optimize/named_problems.hpp"
#include "optimize/output_names.hpp"

namespace wingbeat {

void OptimizeSettings::describe(SettingSection& keys) {
  keys.add(
      "problem", &problem,
      {.help = "a named problem, objective and constraints, in place of objective; constraints add to it",
       .allowed = problem_names()});
  keys.add(
      "objective", &objective,
      {.help = "an output, \"flutter_speed\" (which holds where neither problem nor objective is given), "
               "in its natural sense; or \"maximize ...\" or \"minimize ...\" an output or a sum of "
               "outputs relative to their baselines, \"maximize flutter_speed - 1.1 drag\""});
  keys.add(
      "constraints", &constraints,
      {.help = "each \"OUTPUT RELATION BOUND\": relation <=, >= or =; bound a number, \"baseline\" (the "
               "value of the undeformed shape) or \"0.98 baseline\"; then, if wanted, \"scale 0.05\", the "
               "violation that matters"});
  keys.add("monitor", &monitor,
           {.help = "further outputs, followed on the way and reported", .allowed = output_names()});
  keys.add("variables", &variables,
           {.help = "bumps: amplitudes of the shape variables (see design); angle_of_attack",
            .allowed = {"bumps", "angle_of_attack"}});
  keys.add("angle_bound_deg", &angle_bound_deg,
           {.help = "largest change of the angle of attack, either way", .unit = "deg", .range = above(0)});
  keys.add("start", &start,
           {.help = "design to start from, a number a variable, in chords and degrees; empty: zeros"});
  keys.add("max_iterations", &max_iterations,
           {.help = "iterations of the optimiser", .range = between(0, 100000)});
  keys.add("tolerance", &tolerance,
           {.help = "largest error of the scaled optimality conditions", .range = open_interval(0, 1)});
  keys.add("ipopt", &ipopt, {.help = "options of Ipopt, each \"name = value\", passed on to it"});
  keys.add("groups", &groups,
           {.help = "groups of ranks among which the analyses of a design are shared", .range = at_least(1)});
  keys.add("sharpness", &sharpness,
           {.help = "rho of the smooth minimum, which lies below the minimum by at most ln(n)/rho baselines",
            .range = above(0)});
  keys.add("compare", &compare,
           {.help = "verbs that afterwards analyse baseline and optimum from scratch",
            .allowed = {"steady", "flutter", "lco", "pk"}});
  keys.add("root_margin", &root_margin,
           {.help = "flutter roots whose speed exceeds the lowest by less than this part of it are kept from "
                    "falling below it by constraints of their own",
            .range = between(0, 0.5)});
  keys.add("max_bisections", &max_bisections,
           {.help = "halvings of the way from the nearest solved design before one that does not converge is "
                    "given up",
            .range = between(0, 10)});
}

}  // namespace wingbeat
