#pragma once

#include "apps/context.hpp"
#include "flow/flow_level.hpp"
#include "flow/surface.hpp"
#include "structure/aeroelastic_problem.hpp"

namespace wingbeat {

// Writes solution.cgns (all instances, moved meshes, the restart data), surface.csv and mesh.csv into
// the case's folder. Steady flow is one instance. Collective.
void write_solution_files(const Context& context, const FlowLevel<2>& level, const AeroelasticState& state);

// The state that solution.cgns of an earlier run on the same mesh holds. Throws InputError when it is of
// another mesh or holds a number of instances that is not among those allowed. Collective.
AeroelasticState read_restart(const Context& context, const FlowLevel<2>& level,
                              const std::vector<int>& allowed_instances);

}  // namespace wingbeat
