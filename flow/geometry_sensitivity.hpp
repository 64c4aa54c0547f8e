#pragma once

#include <span>

#include "flow/flux_balance.hpp"
#include "flow/loads.hpp"

namespace wingbeat {

// Adds to `sensitivity` those of multipliers . balance(w, ghosts, motion) of one block to its geometry,
// at a given state (eq:geometry-sensitivity). Arguments as in FluxBalance::evaluate; multipliers: [owned
// cell][variable] of the rank.
template <int Dim>
void add_balance_sensitivity(const FlowBlock<Dim>& block, int owned_count,
                             const FlowModel<Dim, double>& model, std::span<const double> w,
                             std::span<const double> ghosts, const RigidMotion<double>& motion,
                             std::span<const double> multipliers, BlockGeometry<Dim>& sensitivity);

// The same of weights . loads, for one wall face; push as in add_wall_load.
template <int Dim>
void add_load_sensitivity(const BlockGeometry<Dim>& geometry, const BoundaryFace& face,
                          const RigidMotion<double>& motion, double push, const Loads<double>& weights,
                          BlockGeometry<Dim>& sensitivity);

}  // namespace wingbeat
