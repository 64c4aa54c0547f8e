#pragma once

#include <optional>
#include <vector>

#include "apps/cycle_solver.hpp"
#include "flow/steady_sequence.hpp"

namespace wingbeat {

// What leads a case to its first cycle of the given energy: the restart where it holds a periodic
// solution and is not asked for all roots, else steady flow and linear flutter, whose results it reports.
// Nothing where that ends the run: `status` and the result's message then say why. Collective.
struct CycleApproach {
  SolveStatus status = SolveStatus::converged;
  std::optional<CycleStart> start;
  std::vector<CycleStart> further;  // at the flutter roots above, with flutter.roots = "all"
};
CycleApproach approach_cycle(Context& context, FlowLevels<2>& levels, const StructureModel& model,
                             CycleSolver& solver, double energy, History& history,
                             bool needs_all_roots = false);

}  // namespace wingbeat
