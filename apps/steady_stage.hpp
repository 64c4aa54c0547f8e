#pragma once

#include "apps/context.hpp"
#include "apps/history.hpp"
#include "flow/steady_sequence.hpp"

namespace wingbeat {

// Steady flow about the undeformed section on all levels, with progress lines: writes history.csv and,
// once the finest mesh is reached, the solution files (also the checkpoint of later stages), prints the
// loads and puts them into result.json; says in its message why it did not converge. Collective.
SolveStatus run_steady_stage(Context& context, FlowLevels<2>& levels, History& history);

// The motion of the undeformed section: at rest at its mean pitch.
MotionState at_rest(const CaseSettings& settings);

}  // namespace wingbeat
