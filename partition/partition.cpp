#include "partition/partition.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "core/io/error.hpp"
#include "core/mesh/coarsen.hpp"
#include "partition/block_graph.hpp"
#include "partition/coarsening.hpp"
#include "partition/recursive_bisection.hpp"
#include "partition/split_blocks.hpp"

namespace wingbeat {
namespace {

// Pieces of fewer cells are not offered to METIS: too many, too thin.
constexpr std::size_t least_piece = 4;

void check_request(std::size_t cells, int ranks, const PartitionOptions& options) {
  if (ranks < 1) throw InputError("partition: " + std::to_string(ranks) + " ranks, at least 1 is needed");
  if (static_cast<std::size_t>(ranks) > cells)
    throw InputError("partition: " + std::to_string(ranks) + " ranks for a mesh of " + std::to_string(cells) +
                     " cells, each rank needs at least one; use at most " + std::to_string(cells) +
                     " ranks or refine the mesh");
  if (!(options.imbalance >= 0.0))
    throw InputError("partition: an imbalance of " + std::to_string(options.imbalance) +
                     ", allowed is 0 or more (0.05 lets the heaviest rank hold 5 % more than the mean)");
  ensure(options.granularity >= 1 && std::has_single_bit(static_cast<unsigned>(options.granularity)),
         "a granularity of " + std::to_string(options.granularity) + ", which is no power of two");
  // METIS adds up weights in 32 bits.
  if (cells > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw InputError("partition: a mesh of " + std::to_string(cells) + " cells, at most " +
                     std::to_string(std::numeric_limits<int>::max()) + " are supported");
}

// Cells that the heaviest rank may hold: the imbalance asked for, or the best that whole cells allow.
std::size_t largest_share(std::size_t cells, int ranks, double imbalance) {
  const std::size_t n = static_cast<std::size_t>(ranks);
  const double allowed = (1.0 + imbalance) * static_cast<double>(cells) / static_cast<double>(ranks);
  const std::size_t least = (cells + n - 1) / n;
  return std::max(least, static_cast<std::size_t>(std::min(allowed, static_cast<double>(cells))));
}

// A division and what it costs: fewer faces cut first, then fewer blocks.
template <int Dim>
struct Candidate {
  std::vector<SubBlock<Dim>> blocks;
  std::size_t edge_cut = 0;

  auto cost() const { return std::tuple(edge_cut, blocks.size()); }
};

// Equal pieces of the zones, about `pieces_per_rank` for each rank.
template <int Dim>
std::vector<SubBlock<Dim>> split_zones(const MultiblockMesh<Dim>& mesh, int ranks, int pieces_per_rank) {
  const double piece =
      static_cast<double>(mesh.cell_count()) / (static_cast<double>(ranks) * pieces_per_rank);
  std::vector<SubBlock<Dim>> blocks;
  for (std::size_t z = 0; z < mesh.zones.size(); ++z) {
    const Box<Dim> zone = box_of<Dim>(mesh.zones[z].cells);
    const int pieces = static_cast<int>(std::ceil(static_cast<double>(zone.size()) / piece));
    for (const Box<Dim>& box : split_box(zone, pieces)) blocks.push_back({static_cast<int>(z), box, 0});
  }
  return blocks;
}

template <int Dim>
Candidate<Dim> by_recursive_bisection(const MultiblockMesh<Dim>& mesh, int ranks, std::size_t limit) {
  std::vector<SubBlock<Dim>> blocks = merge_blocks(bisect_recursively(mesh, ranks, limit));
  std::vector<int> rank_of(blocks.size());
  std::ranges::transform(blocks, rank_of.begin(), &SubBlock<Dim>::rank);
  const std::size_t cut = edge_cut(build_block_graph<Dim>(mesh, blocks), rank_of);
  return {std::move(blocks), cut};
}

template <int Dim>
Candidate<Dim> by_metis(const MultiblockMesh<Dim>& mesh, int ranks, int pieces_per_rank, double imbalance) {
  std::vector<SubBlock<Dim>> blocks = split_zones(mesh, ranks, pieces_per_rank);
  const BlockGraph graph = build_block_graph<Dim>(mesh, blocks);
  const std::vector<int> rank_of = divide_graph(graph, ranks, imbalance);
  for (std::size_t b = 0; b < blocks.size(); ++b) blocks[b].rank = rank_of[b];
  return {merge_blocks(std::move(blocks)), edge_cut(graph, rank_of)};
}

// Every rank has cells and none more than the limit.
template <int Dim>
bool is_balanced(const std::vector<SubBlock<Dim>>& blocks, int ranks, std::size_t limit) {
  std::vector<std::size_t> cells(ranks, 0);
  for (const SubBlock<Dim>& block : blocks) cells[block.rank] += block.cells.size();
  const auto [least, most] = std::ranges::minmax(cells);
  return least > 0 && most <= limit;
}

// The division at planes of any number.
template <int Dim>
Partition<Dim> divide(const MultiblockMesh<Dim>& mesh, int ranks, double imbalance) {
  const std::size_t cells = mesh.cell_count();
  const std::size_t limit = largest_share(cells, ranks, imbalance);
  Candidate<Dim> best = by_recursive_bisection(mesh, ranks, limit);
  // The coarsest splitting with which METIS keeps the balance gives the fewest blocks. Out of
  // balance and yet cutting more than the bisection, it would not improve with finer pieces.
  for (const int pieces_per_rank : {2, 4, 8, 16}) {
    if (static_cast<std::size_t>(ranks) * pieces_per_rank * least_piece > cells) break;
    Candidate<Dim> found = by_metis(mesh, ranks, pieces_per_rank, imbalance);
    const bool balanced = is_balanced(found.blocks, ranks, limit);
    if (balanced && found.cost() < best.cost()) best = std::move(found);
    if (balanced || found.edge_cut > best.edge_cut) break;
  }
  return {ranks, std::move(best.blocks)};
}

}  // namespace

template <int Dim>
Partition<Dim> partition_mesh(const MultiblockMesh<Dim>& mesh, int ranks, const PartitionOptions& options) {
  const std::size_t cells = mesh.cell_count();
  check_request(cells, ranks, options);
  if (ranks == 1) {
    Partition<Dim> partition{ranks, {}};
    for (std::size_t z = 0; z < mesh.zones.size(); ++z)
      partition.blocks.push_back({static_cast<int>(z), box_of<Dim>(mesh.zones[z].cells), 0});
    return partition;
  }
  // Planes of a coarse mesh are those whose number in the fine one is a multiple of the granularity.
  std::vector<MultiblockMesh<Dim>> coarser;
  for (int granularity = 2; granularity <= options.granularity; granularity *= 2) {
    auto next = coarsened(coarser.empty() ? mesh : coarser.back(), 1);
    if (!next || next->cell_count() < static_cast<std::size_t>(ranks)) break;
    coarser.push_back(std::move(*next));
  }
  const std::size_t limit = largest_share(cells, ranks, options.imbalance);
  for (; !coarser.empty(); coarser.pop_back()) {
    const MultiblockMesh<Dim>& coarse = coarser.back();
    Partition<Dim> found = refined(divide(coarse, ranks, options.imbalance), coarse, mesh);
    if (is_balanced(found.blocks, ranks, limit)) return found;
  }
  return divide(mesh, ranks, options.imbalance);
}

template Partition<2> partition_mesh<2>(const MultiblockMesh<2>&, int, const PartitionOptions&);
template Partition<3> partition_mesh<3>(const MultiblockMesh<3>&, int, const PartitionOptions&);

}  // namespace wingbeat
