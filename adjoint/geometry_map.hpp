#pragma once

#include <span>
#include <vector>

#include "flow/block_geometry.hpp"

namespace wingbeat {

// How area vectors, moments and volumes of a block follow its nodes and the axis of rotation
// (eq:face-moment), and the transpose. `local`: LocalNodes::blocks of the block, -1 where a node does not
// count.

// The change that changes of the nodes [local node] and of the axis cause.
template <int Dim>
BlockGeometry<Dim> geometry_change(const LocalBlock<Dim>& block, const BlockArray<int, Dim>& local,
                                   const BlockGeometry<Dim>& at, const Vec<double, 2>& axis,
                                   std::span<const Vec<double, Dim>> nodes,
                                   const Vec<double, 2>& axis_change);

// Adds sensitivities to the geometry to those to the nodes; returns those to the axis.
template <int Dim>
Vec<double, 2> add_node_sensitivity(const LocalBlock<Dim>& block, const BlockArray<int, Dim>& local,
                                    const BlockGeometry<Dim>& at, const Vec<double, 2>& axis,
                                    const BlockGeometry<Dim>& sensitivity, std::span<Vec<double, Dim>> nodes);

}  // namespace wingbeat
