#pragma once

#include <span>

#include "flow/flow_inputs.hpp"

namespace wingbeat {

// Sensitivities of
//   sum_n (multipliers_n . R_n + weights_n . loads_n)
// to the inputs at a given state: the transpose of flow_tangent (eq:flow-inputs). Every face is
// differentiated by dual numbers and contracted with the multipliers at once; no matrix is formed. The
// flow must be linearized at `at`. Those to the geometry are of this rank's blocks, halo included; the
// others are summed over ranks. Collective.
template <int Dim>
FlowInputs<Dim> flow_sensitivity(const FlowEquations<Dim>& flow, const FlowPoint& at,
                                 std::span<const double> multipliers, std::span<const Loads<double>> weights);

}  // namespace wingbeat
