#pragma once

#include "adjoint/objective.hpp"
#include "adjoint/shape_variables.hpp"
#include "apps/context.hpp"
#include "flow/steady_sequence.hpp"

namespace wingbeat {

// The solution that a case's objective is a number of, found by the stages of the verb it belongs to, as an
// objective over all parameters, solved at the case's own. The levels and the shape outlive it.
struct GradientPrimal {
  SolveStatus status = SolveStatus::converged;
  Objective<2> objective;
  double value_offset = 0.0;  // the number asked for is this much more than the objective's value
};
GradientPrimal solve_gradient_primal(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape);

// Which problem that is, in the words of messages.
std::string primal_name(const CaseSettings& settings);

}  // namespace wingbeat
