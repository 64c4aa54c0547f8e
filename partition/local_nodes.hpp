#pragma once

#include <vector>

#include "core/mesh/node_numbers.hpp"
#include "partition/local_mesh.hpp"

namespace wingbeat {

// The nodes that a rank sees: those of its blocks and of one layer of neighbours.
template <int Dim>
struct LocalNodes {
  std::vector<int> numbers;  // in the whole mesh, of each local node; ascending
  // Local index of each node, in the shape and halo of LocalBlock::nodes; -1 where that is only
  // extrapolated, beyond physical boundaries and at corners.
  std::vector<BlockArray<int, Dim>> blocks;
};

// A pure function of its arguments, so that it can be inspected without running on that many ranks.
template <int Dim>
LocalNodes<Dim> build_local_nodes(const MultiblockMesh<Dim>& mesh, const NodeNumbers<Dim>& numbers,
                                  const LocalMesh<Dim>& local);

}  // namespace wingbeat
