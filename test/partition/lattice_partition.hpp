#pragma once

#include <random>

#include "partition/partition.hpp"
#include "partition/split_blocks.hpp"

namespace wingbeat {

// Cuts anywhere, blocks of a single cell included, dealt to ranks at random.
template <int Dim>
Partition<Dim> random_partition(const MultiblockMesh<Dim>& mesh, int ranks, unsigned seed) {
  std::mt19937 random(seed);
  Partition<Dim> partition{ranks, {}};
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    partition.blocks.push_back({static_cast<int>(z), box_of<Dim>(mesh.zones[z].cells), 0});
  for (int cut = 0; cut < 6 * ranks; ++cut) {
    SubBlock<Dim>& block = partition.blocks[random() % partition.blocks.size()];
    const int d = static_cast<int>(random() % Dim);
    if (block.cells.extent(d) < 2) continue;
    const int plane = block.cells.begin[d] + 1 + static_cast<int>(random() % (block.cells.extent(d) - 1));
    const auto [low, high] = cut_at(block.cells, d, plane);
    const SubBlock<Dim> upper{block.zone, high, 0};
    block.cells = low;
    partition.blocks.push_back(upper);
  }
  for (std::size_t b = 0; b < partition.blocks.size(); ++b)
    partition.blocks[b].rank =
        b < static_cast<std::size_t>(ranks) ? static_cast<int>(b) : static_cast<int>(random() % ranks);
  return partition;
}

}  // namespace wingbeat
