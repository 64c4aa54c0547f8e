#pragma once

#include "apps/context.hpp"
#include "apps/history.hpp"
#include "flow/steady_sequence.hpp"

namespace wingbeat {

// Steady flow about the undeformed section on all levels, with progress lines: writes history.csv and,
// once the finest mesh is reached, the solution files (also the checkpoint of later stages), prints the
// loads and puts them into result.json; says in its message why it did not converge. Newton solves all
// levels on its way; Runge-Kutta cycles need the finest only: the coarser ones are then solved only where
// a later stage asks for them. Collective.
SolveStatus run_steady_stage(Context& context, FlowLevels<2>& levels, History& history,
                             bool needs_coarse_levels = false);

// The motion of the undeformed section: at rest at its mean pitch.
MotionState at_rest(const CaseSettings& settings);

}  // namespace wingbeat
