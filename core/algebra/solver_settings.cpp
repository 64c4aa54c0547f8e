#include "core/algebra/solver_settings.hpp"

namespace wingbeat {

void SolverSettings::describe(SettingSection& keys) {
  keys.add(
      "method", &method,
      {.help =
           "coupled: Newton on flow, structure, phase and amplitude at once; staggered: Runge-Kutta cycles "
           "of the flow in turn with structural steps, which needs little memory",
       .allowed = {"coupled", "staggered"}});
  keys.add(
      "flow_method", &flow_method,
      {.help = "newton; runge_kutta: multigrid cycles; runge_kutta_newton: cycles down to newton_switch, "
               "then Newton (on all rows at once where the method is staggered); unset: newton where the "
               "method is coupled, runge_kutta where it is staggered",
       .allowed = {"newton", "runge_kutta", "runge_kutta_newton"}});
  keys.add("newton_switch", &newton_switch,
           {.help = "flow residual, relative to uniform flow, below which Newton takes over from cycles",
            .range = open_interval(0, 1)});
  keys.add("steady_tolerance", &steady_tolerance,
           {.help = "steady flow residual, relative to uniform flow; unset: 1e-11, by cycles alone 1e-10",
            .range = open_interval(0, 1)});
  keys.add("flow_tolerance", &flow_tolerance,
           {.help = "flow residual of the periodic problem, relative to uniform flow at rest",
            .range = open_interval(0, 1)});
  keys.add("structure_tolerance", &structure_tolerance,
           {.help = "scaled residuals of structure, phase and energy", .range = open_interval(0, 1)});
  keys.add("max_steady_iterations", &max_steady_iterations,
           {.help = "pseudo-transient Newton iterations allowed on a mesh", .range = between(1, 100000)});
  keys.add("max_newton_iterations", &max_newton_iterations,
           {.help = "Newton iterations allowed for the coupled problem", .range = between(1, 10000)});
  keys.add("max_linear_iterations", &max_linear_iterations,
           {.help = "GMRES iterations allowed in one linear solve", .range = between(1, 100000)});
  keys.add("krylov_restart", &krylov_restart,
           {.help = "GMRES vectors kept before a restart", .range = between(2, 10000)});
  keys.add("krylov_deflation", &krylov_deflation,
           {.help = "directions that converge slowest, kept by GMRES over a restart where krylov_restart has "
                    "room for them; 0: none",
            .range = between(0, 1000)});
  keys.add(
      "overlap", &overlap,
      {.help = "layers of cells shared by the ranks' subdomain factorisations", .range = between(0, 64)});
  keys.add(
      "subdomain", &subdomain,
      {.help = "lu: the ranks' matrices are factored exactly; ilu: incompletely, with a small part of the "
               "memory and more GMRES iterations",
       .allowed = {"lu", "ilu"}});
  keys.add("ilu_fill", &ilu_fill,
           {.help = "level of fill that ilu keeps: more takes memory and spares iterations",
            .range = between(0, 10)});
  keys.add(
      "coarse_levels", &coarse_levels,
      {.help = "coarser meshes solved first; each halves the cells of a direction", .range = between(0, 8)});
}

}  // namespace wingbeat
