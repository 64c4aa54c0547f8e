#include "flow/pseudo_time_settings.hpp"

namespace wingbeat {

PseudoTimeOptions PseudoTimeSettings::options(const Scheme& scheme, double tolerance) const {
  // Upwinding damps more than five stages made for central schemes bear at longer steps.
  const bool is_upwind =
      std::holds_alternative<RoeScheme>(scheme) || std::holds_alternative<VanLeerScheme>(scheme);
  PseudoTimeOptions options;
  options.tolerance = tolerance;
  options.max_cycles = max_cycles;
  options.max_retreats = max_retreats;
  options.multigrid.levels = levels;
  options.multigrid.recursion = cycle == "v" ? 1 : 2;
  options.multigrid.runge_kutta = {.cfl = cfl.value_or(is_upwind ? 3.0 : 5.0), .smoothing = smoothing};
  return options;
}

int PseudoTimeSettings::granularity() const {
  constexpr int usual_levels = 5;
  return 1 << (levels.value_or(usual_levels) - 1);
}

void PseudoTimeSettings::describe(SettingSection& keys) {
  keys.add("cfl", &cfl,
           {.help = "CFL number of the Runge-Kutta steps; unset: 5, with upwind schemes 3",
            .range = {.lower = 0.0, .upper = 100.0, .lower_open = true}});
  keys.add("smoothing", &smoothing,
           {.help = "CFL number over that of residuals without implicit smoothing; 0: no smoothing",
            .range = between(0, 10)});
  keys.add("cycle", &cycle,
           {.help = "w: two visits to the coarser mesh a visit of a mesh; v: one", .allowed = {"v", "w"}});
  keys.add(
      "levels", &levels,
      {.help = "meshes of the multigrid cycle, the finest included; unset: as many as every block allows",
       .range = between(1, 12)});
  keys.add("full_multigrid", &full_multigrid,
           {.help = "start on the coarsest mesh instead of with uniform flow on the finest"});
  keys.add("max_cycles", &max_cycles,
           {.help = "cycles allowed on the finest mesh", .range = between(1, 10000000)});
  keys.add("max_retreats", &max_retreats,
           {.help = "times that a diverging flow may go back to its last good state with half the CFL number",
            .range = between(0, 100)});
}

}  // namespace wingbeat
