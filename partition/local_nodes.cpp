#include "partition/local_nodes.hpp"

#include <algorithm>

#include "partition/halo_nodes.hpp"

namespace wingbeat {

template <int Dim>
LocalNodes<Dim> build_local_nodes(const MultiblockMesh<Dim>& mesh, const NodeNumbers<Dim>& numbers,
                                  const LocalMesh<Dim>& local) {
  LocalNodes<Dim> nodes;
  for (const LocalBlock<Dim>& block : local.blocks) {
    BlockArray<int, Dim>& own = nodes.blocks.emplace_back(block.nodes.extents(), block.nodes.halo(), -1);
    for_each_node_with_halo(mesh, block.zone, block.zone_cells,
                            [&](const Index<Dim>& index, int zone, const Index<Dim>& node) {
                              own(index) = numbers.zones[zone](node);
                            });
    std::copy_if(own.data(), own.data() + own.size(), std::back_inserter(nodes.numbers),
                 [](int number) { return number >= 0; });
  }
  std::ranges::sort(nodes.numbers);
  const auto repeated = std::ranges::unique(nodes.numbers);
  nodes.numbers.erase(repeated.begin(), repeated.end());

  for (BlockArray<int, Dim>& block : nodes.blocks)
    for (int& entry : std::span(block.data(), block.size()))
      if (entry >= 0)
        entry = static_cast<int>(std::ranges::lower_bound(nodes.numbers, entry) - nodes.numbers.begin());
  return nodes;
}

template LocalNodes<2> build_local_nodes<2>(const MultiblockMesh<2>&, const NodeNumbers<2>&,
                                            const LocalMesh<2>&);
template LocalNodes<3> build_local_nodes<3>(const MultiblockMesh<3>&, const NodeNumbers<3>&,
                                            const LocalMesh<3>&);

}  // namespace wingbeat
