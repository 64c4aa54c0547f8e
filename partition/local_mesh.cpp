#include "partition/local_mesh.hpp"

#include <algorithm>
#include <string>

#include "core/io/error.hpp"
#include "partition/block_lookup.hpp"
#include "partition/cell_offset.hpp"
#include "partition/halo_cells.hpp"
#include "partition/halo_nodes.hpp"

namespace wingbeat {
namespace {

template <int Dim>
Index<Dim> relative(Index<Dim> index, const Index<Dim>& begin) {
  for (int d = 0; d < Dim; ++d) index[d] -= begin[d];
  return index;
}

// Which rank owns a cell and its number there: the blocks of a rank are numbered one after the
// other, in the order of the partition.
template <int Dim>
class CellOwners {
 public:
  CellOwners(std::size_t zones, const Partition<Dim>& partition)
      : blocks_(partition.blocks), lookup_(static_cast<int>(zones), blocks_) {
    std::vector<int> cells(partition.ranks, 0);
    for (const SubBlock<Dim>& block : blocks_) {
      first_cell_.push_back(cells.at(block.rank));
      cells[block.rank] += static_cast<int>(block.cells.size());
    }
  }

  int first_cell(std::size_t block) const { return first_cell_[block]; }

  GhostSource owner(int zone, const Index<Dim>& cell) const {
    const int b = lookup_.find(zone, cell);
    const SubBlock<Dim>& block = blocks_[b];
    return {block.rank, first_cell_[b] + static_cast<int>(cell_offset<Dim>(block.cells, cell))};
  }

 private:
  std::span<const SubBlock<Dim>> blocks_;
  BlockLookup<Dim> lookup_;
  std::vector<int> first_cell_;  // of each block
};

template <int Dim>
std::vector<BoundaryPatch<Dim>> clipped_patches(const Zone<Dim>& zone, const Box<Dim>& box) {
  std::vector<BoundaryPatch<Dim>> clipped;
  for (BoundaryPatch<Dim> patch : zone.patches) {
    for (int d = 0; d < Dim; ++d) {
      patch.cells.begin[d] = std::max(patch.cells.begin[d], box.begin[d]) - box.begin[d];
      patch.cells.end[d] = std::min(patch.cells.end[d], box.end[d]) - box.begin[d];
    }
    if (patch.cells.size() > 0) clipped.push_back(std::move(patch));
  }
  return clipped;
}

// A block with everything but the numbers of its halo cells.
template <int Dim>
LocalBlock<Dim> make_block(const MultiblockMesh<Dim>& mesh, const SubBlock<Dim>& sub, int first_cell) {
  LocalBlock<Dim> block;
  block.zone = sub.zone;
  block.zone_cells = sub.cells;
  for (int d = 0; d < Dim; ++d) block.extents[d] = sub.cells.extent(d);
  block.first_cell = first_cell;
  block.cell_number = BlockArray<int, Dim>(block.extents, halo_layers, -1);
  int number = first_cell;
  for_each(box_of<Dim>(block.extents), [&](const Index<Dim>& cell) { block.cell_number(cell) = number++; });
  block.nodes = nodes_with_halo(mesh, sub.zone, sub.cells);
  block.patches = clipped_patches(mesh.zones[sub.zone], sub.cells);
  return block;
}

// The owner of each halo cell of the rank's blocks, in the order of for_each_halo_cell.
template <int Dim>
std::vector<GhostSource> halo_owners(const MultiblockMesh<Dim>& mesh, const CellOwners<Dim>& owners,
                                     const std::vector<LocalBlock<Dim>>& blocks) {
  std::vector<GhostSource> sources;
  for (const LocalBlock<Dim>& block : blocks)
    for_each_halo_cell(mesh, block.zone, block.zone_cells, halo_layers, [&](const HaloCell<Dim>& halo) {
      sources.push_back(owners.owner(halo.position.zone, halo.position.cell));
    });
  return sources;
}

std::vector<GhostSource> ghosts_among(std::vector<GhostSource> sources, int rank) {
  std::erase_if(sources, [rank](const GhostSource& source) { return source.rank == rank; });
  std::ranges::sort(sources);
  const auto repeated = std::ranges::unique(sources);
  sources.erase(repeated.begin(), repeated.end());
  return sources;
}

template <int Dim>
void number_halo_cells(const MultiblockMesh<Dim>& mesh, const std::vector<GhostSource>& sources, int rank,
                       LocalMesh<Dim>& local) {
  auto source = sources.begin();
  for (LocalBlock<Dim>& block : local.blocks)
    for_each_halo_cell(mesh, block.zone, block.zone_cells, halo_layers, [&](const HaloCell<Dim>& halo) {
      int& number = block.cell_number(relative<Dim>(halo.index, block.zone_cells.begin));
      if (source->rank == rank)
        number = source->index;
      else
        number = local.owned_count +
                 static_cast<int>(std::ranges::lower_bound(local.ghosts, *source) - local.ghosts.begin());
      ++source;
    });
}

template <int Dim>
std::vector<long> global_numbers(const MultiblockMesh<Dim>& mesh,
                                 const std::vector<LocalBlock<Dim>>& blocks) {
  std::vector<long> zone_start{0};
  for (const Zone<Dim>& zone : mesh.zones)
    zone_start.push_back(zone_start.back() + static_cast<long>(box_of<Dim>(zone.cells).size()));
  std::vector<long> numbers;
  for (const LocalBlock<Dim>& block : blocks) {
    const Box<Dim> zone = box_of<Dim>(mesh.zones[block.zone].cells);
    for_each(block.zone_cells, [&](const Index<Dim>& cell) {
      numbers.push_back(zone_start[block.zone] + static_cast<long>(cell_offset<Dim>(zone, cell)));
    });
  }
  return numbers;
}

}  // namespace

template <int Dim>
LocalMesh<Dim> build_local_mesh(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition, int rank) {
  ensure(rank >= 0 && rank < partition.ranks, "rank " + std::to_string(rank) + " of a partition for " +
                                                  std::to_string(partition.ranks) + " ranks");
  const CellOwners<Dim> owners(mesh.zones.size(), partition);
  LocalMesh<Dim> local;
  for (std::size_t b = 0; b < partition.blocks.size(); ++b) {
    const SubBlock<Dim>& sub = partition.blocks[b];
    if (sub.rank != rank) continue;
    local.blocks.push_back(make_block(mesh, sub, owners.first_cell(b)));
    local.owned_count += static_cast<int>(sub.cells.size());
  }
  const std::vector<GhostSource> sources = halo_owners(mesh, owners, local.blocks);
  local.ghosts = ghosts_among(sources, rank);
  number_halo_cells(mesh, sources, rank, local);
  local.global_cell = global_numbers(mesh, local.blocks);
  return local;
}

template LocalMesh<2> build_local_mesh<2>(const MultiblockMesh<2>&, const Partition<2>&, int);
template LocalMesh<3> build_local_mesh<3>(const MultiblockMesh<3>&, const Partition<3>&, int);

}  // namespace wingbeat
