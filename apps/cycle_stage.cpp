#include "apps/cycle_stage.hpp"

#include "apps/flow_setup.hpp"
#include "apps/linear_flutter_output.hpp"
#include "apps/solution_output.hpp"
#include "apps/steady_stage.hpp"

namespace wingbeat {

CycleApproach approach_cycle(Context& context, FlowLevels<2>& levels, const StructureModel& model,
                             CycleSolver& solver, double energy, History& history) {
  const CaseSettings& settings = context.settings;
  FlowLevel<2>& level = *levels.back();
  if (context.restart) {
    // A periodic solution goes straight on; a steady one is where the steady flow starts.
    AeroelasticState state = read_restart(context, level, {1, 2 * settings.time.harmonics + 1});
    if (state.y.size() > 4) return {SolveStatus::converged, solver.restart(std::move(state))};
    level.w = std::move(state.w);
  }
  const SolveStatus steady = run_steady_stage(context, levels, history, true);
  if (steady != SolveStatus::converged) return {steady, std::nullopt};

  // By turns, the root of the next coarser mesh is near enough to start from.
  const FlowLevelRange<2> all(levels);
  const FlowLevelRange<2> linearized =
      settings.solver.is_staggered() && levels.size() > 1 ? all.first(levels.size() - 1) : all;
  LinearFlutterSolution<2> linear;
  {
    const auto part = context.timer.measure("linear flutter");
    linear = solve_linear_flutter<2>(linearized, model, section_kinematics(settings),
                                     linear_flutter_options(context));
  }
  report_linear_flutter(context, linear.flutter);
  if (!linear.flutter.root) {
    context.result.message = no_flutter_message(settings);
    return {SolveStatus::stalled, std::nullopt};
  }
  return {SolveStatus::converged, solver.linear_start(linear, *linearized.back(), energy)};
}

}  // namespace wingbeat
