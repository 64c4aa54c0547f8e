#pragma once

#include <vector>

#include "flow/flow_inputs.hpp"

namespace wingbeat {

// How residuals and loads change at a given state.
struct FlowTangent {
  std::vector<double> residual;      // [instance][owned cell][variable]
  std::vector<Loads<double>> loads;  // [instance]
};

// Their change with the inputs, by dual numbers that run through all of the flow equations
// (eq:flow-inputs). Collective.
template <int Dim>
FlowTangent flow_tangent(const FlowEquations<Dim>& flow, const FlowPoint& at, const FlowInputs<Dim>& change);

}  // namespace wingbeat
