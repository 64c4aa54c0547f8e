#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "flow/flow_level.hpp"
#include "flow/pseudo_transient.hpp"

namespace wingbeat {

// The same flow on a sequence of meshes, coarsest first.
template <int Dim>
using FlowLevels = std::vector<std::unique_ptr<FlowLevel<Dim>>>;
// Some of them, next to one another.
template <int Dim>
using FlowLevelRange = std::span<const std::unique_ptr<FlowLevel<Dim>>>;

// Return false to stop early. `level` counts from the coarsest, 0.
using SequenceObserver = std::function<bool(std::size_t level, const PseudoTransientIteration&)>;

// Steady flow by grid sequencing: each mesh starts from its w where that is given already, else from
// the solution of the last coarser one that converged, else from the w given of the finest, else from uniform
// flow. Coarse meshes are solved to 1e-6 or the tolerance, whichever is larger; one that does not converge is
// left without w. Leaves every solved level's w and factors. The result is that of the finest mesh.
// Collective.
template <int Dim>
PseudoTransientResult solve_steady(FlowLevelRange<Dim> levels, const MotionState& motion,
                                   const PseudoTransientOptions& options,
                                   const SequenceObserver& observer = {});

}  // namespace wingbeat
