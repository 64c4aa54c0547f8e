#pragma once

#include <memory>
#include <vector>

#include "adjoint/flow_analysis.hpp"
#include "adjoint/shape_variables.hpp"
#include "apps/context.hpp"
#include "apps/history.hpp"
#include "flow/steady_sequence.hpp"

namespace wingbeat {

// Flows whose loads are differentiated, found by the stages of `steady` and `pitch`, as analyses solved at
// the case's own parameters. Where `status` tells of none, so does the result's message. Levels and shape
// outlive them. Collective.
struct LoadPrimal {
  SolveStatus status = SolveStatus::converged;
  std::unique_ptr<FlowAnalysis<2>> analysis;
};
LoadPrimal steady_primal(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape,
                         History& history, std::vector<WeightedLoad> objective);
LoadPrimal forced_primal(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape,
                         History& history, std::vector<WeightedLoad> objective);

}  // namespace wingbeat
