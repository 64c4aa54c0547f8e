#pragma once

#include <span>
#include <vector>

#include "partition/partition.hpp"

namespace wingbeat {

// Sub-blocks as vertices (weight: cells), joined where they share faces (weight: shared faces).
// Vertex v has neighbours[starts[v]] .. neighbours[starts[v + 1] - 1].
struct BlockGraph {
  std::vector<int> weights;
  std::vector<int> starts;
  std::vector<int> neighbours;
  std::vector<int> faces;
};

// In time about proportional to the surface of the sub-blocks.
template <int Dim>
BlockGraph build_block_graph(const MultiblockMesh<Dim>& mesh, std::span<const SubBlock<Dim>> blocks);

// Faces between blocks of different ranks.
std::size_t edge_cut(const BlockGraph& graph, std::span<const int> ranks);

// Rank of each vertex by METIS k-way, cutting few faces; `imbalance` is a request that METIS may
// miss. Deterministic. Source: Karypis & Kumar, doi:10.1137/S1064827595287997.
std::vector<int> divide_graph(const BlockGraph& graph, int ranks, double imbalance);

}  // namespace wingbeat
