#pragma once

#include <vector>

#include "flow/flow_equations.hpp"

namespace wingbeat {

// What the flow equations are given beside the state, as a change of it or, in the same layout, as the
// sensitivities of a number to it.
template <int Dim>
struct FlowInputs {
  std::vector<BlockGeometry<Dim>> geometry;  // [block]: area vectors, moments about the axis, volumes
  double mach = 0.0;                         // of the free stream alone: motions and kappa are apart
  double angle = 0.0;                        // of attack, radians
  std::vector<MotionState> motions;          // [instance]
  double kappa = 0.0;

  // All zero.
  explicit FlowInputs(const FlowEquations<Dim>& flow) : motions(flow.instance_count()) {
    for (const auto& block : flow.domain().blocks()) geometry.emplace_back(block.geometry.layout);
  }
};

// Where the flow equations are differentiated: R(w; motions, kappa).
struct FlowPoint {
  std::span<const double> w;  // [instance][owned cell][variable]
  std::span<const MotionState> motions;
  double kappa = 0.0;
};

// The ghost cells of w, [instance][ghost cell][variable]. Collective.
template <int Dim>
std::vector<double> ghost_cells(const FlowEquations<Dim>& flow, std::span<const double> w) {
  constexpr int n = state_size<Dim>;
  const FlowDomain<Dim>& domain = flow.domain();
  std::vector<double> ghosts(flow.instance_count() * static_cast<std::size_t>(domain.ghost_count()) * n);
  domain.exchange().template gather<double>(w, ghosts, flow.time().instances(), n);
  return ghosts;
}

}  // namespace wingbeat
