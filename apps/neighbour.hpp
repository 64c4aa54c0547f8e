#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/context.hpp"
#include "flow/flow_level.hpp"
#include "structure/aeroelastic_problem.hpp"

namespace wingbeat {

// What solved cases beside this one (context.neighbour) give to start from, carried on in a straight line
// from one to the other where there are two. Speeds are in proportion to the Mach number, so that the far
// field is this case's. All functions are collective and throw InputError where a solution cannot be read.

// Steady flow, or the mean of a period; [cell][variable].
std::vector<double> neighbouring_flow(const Context& context, const FlowLevel<2>& level);

// The cycles with this case's harmonics: those at flutter roots, lowest first.
std::vector<AeroelasticState> neighbouring_cycles(const Context& context, const FlowLevel<2>& level);

// Name of the solution at the first, second, ... flutter root by speed: solution.cgns, solution-2.cgns, ...
std::string flutter_file(int number);

// Of some cycles that which may be called the same as one of this speed and frequency; null where none is
// near.
const AeroelasticState* cycle_near(const CaseSettings& settings, double reduced_velocity, double frequency,
                                   const std::vector<AeroelasticState>& cycles);

}  // namespace wingbeat
