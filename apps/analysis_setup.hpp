#pragma once

#include "adjoint/changed_domain.hpp"
#include "adjoint/shape_variables.hpp"
#include "apps/context.hpp"
#include "core/algebra/newton.hpp"
#include "flow/flow_level.hpp"

namespace wingbeat {

// What the analyses of a case, whose solutions are differentiated, are made of. Level and shape are kept by
// reference.
DomainBase<2> domain_base(const Context& context, const FlowLevel<2>& level, const ShapeVariables& shape);
// Newton's method of problems that start near their solutions.
NewtonOptions near_options(const SolverSettings& settings);

// The primal is as good as the case's tolerances ask for; with --check it goes on to round-off, so that
// differences of whole solutions mean something.
double primal_tolerance(const Context& context, double tolerance, double round_off);

}  // namespace wingbeat
