#pragma once

#include <span>
#include <string>

#include "flow/flow_level.hpp"

namespace wingbeat {

// Where a flow went wrong: the first cell whose state w is none of a gas, or, where all are, whose residual r
// is not finite; such as `instance 2 of 3, block "block-1", cell (12, 3) at x = 0.31, y = 0.05: density -0.2,
// pressure 0.7`. Empty where there is none. w and r hold instances of the level's cells; r may be empty.
// Collective.
template <int Dim>
std::string describe_fault(const FlowLevel<Dim>& level, std::span<const double> w,
                           std::span<const double> r = {});

// The same of a state of the whole mesh, [instance][cell][variable], as a file has it. Not collective.
template <int Dim>
std::string describe_fault(const MultiblockMesh<Dim>& mesh, std::span<const double> w, double gamma);

}  // namespace wingbeat
