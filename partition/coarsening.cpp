#include "partition/coarsening.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/mesh/coarsen.hpp"

namespace wingbeat {
namespace {

template <int Dim>
std::string partition_obstacle(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition) {
  for (const SubBlock<Dim>& block : partition.blocks) {
    const Zone<Dim>& zone = mesh.zones[block.zone];
    const auto ratio = coarsening_ratio<Dim>(zone.cells);
    for (int d = 0; d < Dim; ++d)
      for (const int plane : {block.cells.begin[d], block.cells.end[d]})
        if (plane % ratio[d] != 0)
          return fmt::format("zone \"{}\" ({} cells) is cut at {} for rank {}: {} is odd", zone.name,
                             fmt::join(zone.cells, " x "), plane, block.rank, plane);
  }
  return {};
}

template <int Dim>
std::string obstacle(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition, int least_cells) {
  std::string found = coarsening_obstacle(mesh, least_cells);
  return found.empty() ? partition_obstacle(mesh, partition) : found;
}

// Coarsens as often as possible.
template <int Dim>
std::pair<int, CoarseGrid<Dim>> coarsest(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition,
                                         int least_cells) {
  int levels = 0;
  CoarseGrid<Dim> grid{mesh, partition};
  while (auto next = coarsened(grid.mesh, grid.partition, least_cells)) {
    grid = std::move(*next);
    ++levels;
  }
  return {levels, std::move(grid)};
}

}  // namespace

template <int Dim>
std::optional<CoarseGrid<Dim>> coarsened(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition,
                                         int least_cells) {
  if (!partition_obstacle(mesh, partition).empty()) return std::nullopt;
  auto coarse = coarsened(mesh, least_cells);
  if (!coarse) return std::nullopt;
  CoarseGrid<Dim> grid{std::move(*coarse), partition};
  for (SubBlock<Dim>& block : grid.partition.blocks) {
    const auto ratio = coarsening_ratio<Dim>(mesh.zones[block.zone].cells);
    for (int d = 0; d < Dim; ++d) block.cells.begin[d] /= ratio[d], block.cells.end[d] /= ratio[d];
  }
  return grid;
}

template <int Dim>
int coarsening_levels(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition, int least_cells) {
  return coarsest(mesh, partition, least_cells).first;
}

template <int Dim>
std::string describe_limit(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition,
                           int least_cells) {
  const auto [levels, grid] = coarsest(mesh, partition, least_cells);
  const std::string reason = obstacle(grid.mesh, grid.partition, least_cells);
  return levels == 0
             ? reason
             : fmt::format("halved {}, {}", levels == 1 ? "once" : fmt::format("{} times", levels), reason);
}

template <int Dim>
Partition<Dim> refined(Partition<Dim> partition, const MultiblockMesh<Dim>& coarse,
                       const MultiblockMesh<Dim>& fine) {
  for (SubBlock<Dim>& block : partition.blocks)
    for (int d = 0; d < Dim; ++d) {
      const int ratio = fine.zones[block.zone].cells[d] / coarse.zones[block.zone].cells[d];
      block.cells.begin[d] *= ratio;
      block.cells.end[d] *= ratio;
    }
  return partition;
}

template std::optional<CoarseGrid<2>> coarsened(const MultiblockMesh<2>&, const Partition<2>&, int);
template std::optional<CoarseGrid<3>> coarsened(const MultiblockMesh<3>&, const Partition<3>&, int);
template int coarsening_levels(const MultiblockMesh<2>&, const Partition<2>&, int);
template int coarsening_levels(const MultiblockMesh<3>&, const Partition<3>&, int);
template std::string describe_limit(const MultiblockMesh<2>&, const Partition<2>&, int);
template std::string describe_limit(const MultiblockMesh<3>&, const Partition<3>&, int);
template Partition<2> refined(Partition<2>, const MultiblockMesh<2>&, const MultiblockMesh<2>&);
template Partition<3> refined(Partition<3>, const MultiblockMesh<3>&, const MultiblockMesh<3>&);

}  // namespace wingbeat
