#include "partition/block_graph.hpp"

#include <metis.h>

#include <algorithm>
#include <string>

#include "core/io/error.hpp"
#include "partition/block_lookup.hpp"
#include "partition/halo_cells.hpp"

namespace wingbeat {

template <int Dim>
BlockGraph build_block_graph(const MultiblockMesh<Dim>& mesh, std::span<const SubBlock<Dim>> blocks) {
  const BlockLookup<Dim> lookup(static_cast<int>(mesh.zones.size()), blocks);
  BlockGraph graph;
  graph.starts.push_back(0);
  std::vector<int> across;  // block behind each face
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    across.clear();
    for_each_halo_cell(mesh, blocks[b].zone, blocks[b].cells, 1, [&](const HaloCell<Dim>& halo) {
      const CellPosition<Dim>& there = halo.position;
      const bool as_before = !across.empty() && blocks[across.back()].zone == there.zone &&
                             blocks[across.back()].cells.contains(there.cell);
      across.push_back(as_before ? across.back() : lookup.find(there.zone, there.cell));
    });
    std::ranges::sort(across);
    for (auto first = across.begin(); first != across.end();) {
      const auto last = std::upper_bound(first, across.end(), *first);
      if (*first != static_cast<int>(b)) {
        graph.neighbours.push_back(*first);
        graph.faces.push_back(static_cast<int>(last - first));
      }
      first = last;
    }
    graph.starts.push_back(static_cast<int>(graph.neighbours.size()));
    graph.weights.push_back(static_cast<int>(blocks[b].cells.size()));
  }
  return graph;
}

std::size_t edge_cut(const BlockGraph& graph, std::span<const int> ranks) {
  std::size_t twice = 0;
  for (std::size_t v = 0; v < graph.weights.size(); ++v)
    for (int e = graph.starts[v]; e < graph.starts[v + 1]; ++e)
      if (ranks[v] != ranks[graph.neighbours[e]]) twice += static_cast<std::size_t>(graph.faces[e]);
  return twice / 2;
}

std::vector<int> divide_graph(const BlockGraph& graph, int ranks, double imbalance) {
  static_assert(std::is_same_v<idx_t, int>, "METIS with 32-bit indices");
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_UFACTOR] = std::max(1, static_cast<int>(std::min(imbalance, 1e3) * 1000.0));

  // METIS asks for pointers to data it does not change.
  BlockGraph copy = graph;
  idx_t vertices = static_cast<idx_t>(graph.weights.size()), constraints = 1, parts = ranks, cut = 0;
  std::vector<int> part(graph.weights.size(), 0);
  const int status = METIS_PartGraphKway(&vertices, &constraints, copy.starts.data(), copy.neighbours.data(),
                                         copy.weights.data(), nullptr, copy.faces.data(), &parts, nullptr,
                                         nullptr, options, &cut, part.data());
  ensure(status == METIS_OK, "METIS failed with code " + std::to_string(status));
  return part;
}

template BlockGraph build_block_graph<2>(const MultiblockMesh<2>&, std::span<const SubBlock<2>>);
template BlockGraph build_block_graph<3>(const MultiblockMesh<3>&, std::span<const SubBlock<3>>);

}  // namespace wingbeat
