#pragma once

#include "apps/context.hpp"
#include "apps/history.hpp"
#include "flow/forced_flow.hpp"
#include "flow/steady_sequence.hpp"

namespace wingbeat {

// The periodic flow of a case in its prescribed motion: how its solution ended, w of all instances, and the
// factors it was found with.
struct ForcedFlowStage {
  SolveStatus status = SolveStatus::converged;
  ForcedFlowStart flow;
};

// Solves it on the finest level, from steady flow or the restart, writes solution files and loads, and
// reports them. `needs_rest`: the steady flow is wanted in any case. Collective.
ForcedFlowStage run_pitch_stage(Context& context, FlowLevels<2>& levels, History& history, bool needs_rest);

}  // namespace wingbeat
