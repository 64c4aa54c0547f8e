#pragma once

#include <optional>
#include <span>

#include "flow/reduced_response.hpp"
#include "structure/aerodynamic_table.hpp"

namespace wingbeat {

// Q(k) at the k given, ascending, from two factorizations (eq:reduced-response): derivatives are taken into the
// projection until one more changes no entry by more than `accuracy` of the largest, which is several times the
// error then left; nothing where six do not do. `flow_speed` is U on the flow's clock. Collective.
// Throws SolveFailure where a linear solve fails.
template <int Dim>
std::optional<AerodynamicTable> sketched_matrix(const FlowLevel<Dim>& level, double flow_speed,
                                                std::span<const double> k, double accuracy,
                                                const GmresOptions& gmres);

}  // namespace wingbeat
