#pragma once

#include "adjoint/design_variables.hpp"
#include "apps/optimize_root.hpp"

namespace wingbeat {

// Writes baseline and optimum ready to be analysed, and analyses both from scratch as the case asks.
// `outcome`: of rank 0. Collective.
SolveStatus finish_optimization(Context& context, const MultiblockMesh<2>& mesh, const ShapeVariables& shape,
                                const DesignVariables& variables, OptimizationOutcome outcome);

}  // namespace wingbeat
