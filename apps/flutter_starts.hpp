#pragma once

#include <vector>

#include "apps/cycle_solver.hpp"
#include "flow/steady_sequence.hpp"

namespace wingbeat {

// Cycles of the given energy at the flutter roots that the case asks for: first the lowest, then, with
// flutter.roots = "all", the others that rising speed destabilises. All levels
// hold steady solutions. Reports
// the roots; empty where there is none, and the result's message then says so. Collective.
std::vector<CycleStart> flutter_starts(Context& context, FlowLevels<2>& levels, const StructureModel& model,
                                       CycleSolver& solver, double energy);

// The same beside solved cases, whose cycles take the place of linear flutter on the finest mesh. Which roots
// there are is seen on the coarsest. Empty where a root has no cycle near it, or that mesh shows none.
// Collective.
std::vector<CycleStart> neighbouring_starts(Context& context, FlowLevels<2>& levels,
                                            const StructureModel& model, CycleSolver& solver, double energy,
                                            const std::vector<AeroelasticState>& neighbours);

}  // namespace wingbeat
