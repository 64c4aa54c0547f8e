#include <algorithm>

#include "partition/block_lookup.hpp"
#include "partition/cell_offset.hpp"
#include "partition/halo_cells.hpp"
#include "partition/partition.hpp"

namespace wingbeat {
namespace {

// A cell by the block that owns it and its offset there.
struct RemoteCell {
  int block = 0;
  std::size_t offset = 0;
  friend auto operator<=>(const RemoteCell&, const RemoteCell&) = default;
};

// Blocks of each rank.
template <int Dim>
std::vector<std::vector<int>> blocks_by_rank(const Partition<Dim>& partition) {
  std::vector<std::vector<int>> blocks(partition.ranks);
  for (std::size_t b = 0; b < partition.blocks.size(); ++b)
    blocks.at(partition.blocks[b].rank).push_back(static_cast<int>(b));
  return blocks;
}

}  // namespace

template <int Dim>
PartitionStatistics partition_statistics(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition,
                                         int instances) {
  PartitionStatistics statistics;
  statistics.ranks = partition.ranks;
  statistics.blocks = partition.blocks.size();

  const auto& blocks = partition.blocks;
  const BlockLookup<Dim> lookup(static_cast<int>(mesh.zones.size()), blocks);
  std::size_t heaviest = 0, cut_faces_seen = 0;
  std::vector<RemoteCell> halo;
  for (const std::vector<int>& own : blocks_by_rank(partition)) {
    std::size_t cells = 0;
    halo.clear();
    int there = 0;
    for (const int b : own) {
      cells += blocks[b].cells.size();
      for_each_halo_cell(mesh, blocks[b].zone, blocks[b].cells, 2, [&](const HaloCell<Dim>& cell) {
        const auto& [zone, index, axis, sign] = cell.position;
        if (blocks[there].zone != zone || !blocks[there].cells.contains(index))
          there = lookup.find(zone, index);
        if (blocks[there].rank == blocks[b].rank) return;
        if (cell.layer == 1) ++cut_faces_seen;
        halo.push_back({there, cell_offset<Dim>(blocks[there].cells, index)});
      });
    }
    heaviest = std::max(heaviest, cells);
    std::ranges::sort(halo);
    statistics.halo_cells += static_cast<std::size_t>(std::ranges::unique(halo).begin() - halo.begin());
  }
  const double mean = static_cast<double>(mesh.cell_count()) / partition.ranks;
  statistics.imbalance = static_cast<double>(heaviest) / mean - 1.0;
  statistics.edge_cut = cut_faces_seen / 2;  // each is seen from both ranks
  statistics.halo_bytes =
      statistics.halo_cells * static_cast<std::size_t>(instances) * (Dim + 2) * sizeof(double);
  return statistics;
}

template PartitionStatistics partition_statistics<2>(const MultiblockMesh<2>&, const Partition<2>&, int);
template PartitionStatistics partition_statistics<3>(const MultiblockMesh<3>&, const Partition<3>&, int);

}  // namespace wingbeat
