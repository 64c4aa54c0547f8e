#include "apps/cycle_stage.hpp"

#include <iterator>

#include "apps/flutter_starts.hpp"
#include "apps/neighbour.hpp"
#include "apps/restart.hpp"
#include "apps/steady_stage.hpp"
#include "core/spectral/mean_instance.hpp"

namespace wingbeat {

CycleApproach approach_cycle(Context& context, FlowLevels<2>& levels, const StructureModel& model,
                             CycleSolver& solver, double energy, History& history, bool needs_all_roots) {
  const CaseSettings& settings = context.settings;
  FlowLevel<2>& level = *levels.back();
  if (context.restart) {
    // A periodic solution goes straight on; a steady one, or the mean where one cycle is not enough, is where
    // the steady flow starts.
    AeroelasticState state = read_restart(context, level, {1, 2 * settings.time.harmonics + 1});
    const bool is_periodic = state.y.size() > 4;
    if (is_periodic && !needs_all_roots)
      return {SolveStatus::converged, solver.restart(std::move(state)), {}};
    level.w = is_periodic ? mean_instance(state.w, time_of(state)) : std::move(state.w);
    if (is_periodic) context.checkpoints.forget();  // it is of the one cycle
  }
  std::vector<AeroelasticState> neighbours;
  if (context.neighbour) neighbours = neighbouring_cycles(context, level);
  if (level.w.empty() && !neighbours.empty())
    level.w = mean_instance(neighbours.front().w, time_of(neighbours.front()));
  const SolveStatus steady = run_steady_stage(context, levels, history, true);
  if (steady != SolveStatus::converged) return {steady, std::nullopt, {}};

  std::vector<CycleStart> starts;
  if (!neighbours.empty()) starts = neighbouring_starts(context, levels, model, solver, energy, neighbours);
  if (starts.empty()) starts = flutter_starts(context, levels, model, solver, energy);
  if (starts.empty()) return {SolveStatus::stalled, std::nullopt, {}};
  CycleApproach approach{SolveStatus::converged, std::move(starts.front()), {}};
  approach.further.assign(std::make_move_iterator(starts.begin() + 1), std::make_move_iterator(starts.end()));
  return approach;
}

}  // namespace wingbeat
