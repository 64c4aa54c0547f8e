#pragma once

#include "adjoint/parameters.hpp"
#include "partition/local_nodes.hpp"

namespace wingbeat {

// What of a case the map from parameters to inputs depends on; kept by reference, but for the numbers.
template <int Dim>
struct ParameterPoint {
  const LocalMesh<Dim>& mesh;
  const LocalNodes<Dim>& nodes;
  const FlowEquations<Dim>& flow;
  FlowPoint at;
  bool turns_about_elastic_axis = false;
};

// How inputs follow parameters, p = P(b), linearized: faces and volumes by the nodes, frequency and rates of
// motion on the flow's clock by the Mach number (eq:two-clocks), the axis of rotation by the elastic axis.
template <int Dim>
Inputs<Dim> input_change(const ParameterPoint<Dim>& point, const Parameters<Dim>& change);

// The transpose. Those to the nodes are this rank's part: the sum over the ranks that see a node is whole.
// Collective.
template <int Dim>
Parameters<Dim> parameter_sensitivity(const ParameterPoint<Dim>& point, const Inputs<Dim>& sensitivity);

}  // namespace wingbeat
