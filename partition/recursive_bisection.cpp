#include "partition/recursive_bisection.hpp"

#include <algorithm>
#include <array>

#include "core/io/error.hpp"
#include "partition/split_blocks.hpp"

namespace wingbeat {
namespace {

template <int Dim>
using Blocks = std::vector<SubBlock<Dim>>;

template <int Dim>
std::size_t cells_in(const Blocks<Dim>& blocks) {
  std::size_t n = 0;
  for (const auto& block : blocks) n += block.cells.size();
  return n;
}

// How many cells the lower ranks shall get, and how many they may get.
struct Target {
  std::size_t ideal = 0;
  std::size_t least = 0;
  std::size_t most = 0;

  bool allows(std::size_t cells) const { return least <= cells && cells <= most; }
  Target less(std::size_t cells) const {
    return {ideal - cells, least > cells ? least - cells : 0, most - cells};
  }
};

Target target_of_lower(std::size_t cells, std::size_t low_ranks, std::size_t high_ranks, std::size_t limit) {
  const std::size_t ranks = low_ranks + high_ranks;
  Target target;
  target.ideal = low_ranks * (cells / ranks) + std::min(low_ranks, cells % ranks);
  target.least = std::max(low_ranks, cells > high_ranks * limit ? cells - high_ranks * limit : 0);
  target.most = std::min(low_ranks * limit, cells - high_ranks);
  return target;
}

// Cuts a block that holds more than target.ideal > 0 cells.
template <int Dim>
void cut_block(const SubBlock<Dim>& block, const Target& target, Blocks<Dim>& low, Blocks<Dim>& high) {
  const Box<Dim>& box = block.cells;
  const int d = directions_by_extent(box)[0];
  const std::size_t plane = box.size() / box.extent(d);
  const auto piece = [&](const Box<Dim>& cells) { return SubBlock<Dim>{block.zone, cells, 0}; };
  const double share = static_cast<double>(target.ideal) / static_cast<double>(box.size());
  const int below = box.begin[d] + static_cast<int>(target.ideal / plane);
  for (const int cut : {cut_plane(box.begin[d], box.end[d], share), below, below + 1}) {
    if (cut <= box.begin[d] || cut >= box.end[d] || !target.allows(plane * (cut - box.begin[d]))) continue;
    const auto [first, second] = cut_at(box, d, cut);
    low.push_back(piece(first));
    high.push_back(piece(second));
    return;
  }

  Box<Dim> between = box;
  between.begin[d] = below;
  between.end[d] = below + 1;
  if (below > box.begin[d]) low.push_back(piece(cut_at(box, d, below).first));
  const Target rest = target.less(plane * (below - box.begin[d]));
  if (rest.ideal > 0)
    cut_block(piece(between), rest, low, high);
  else
    high.push_back(piece(between));
  if (below + 1 < box.end[d]) high.push_back(piece(cut_at(box, d, below + 1).second));
}

template <int Dim>
void assign(const Blocks<Dim>& blocks, int first_rank, int ranks, std::size_t limit, Blocks<Dim>& assigned) {
  if (ranks == 1) {
    for (SubBlock<Dim> block : blocks) {
      block.rank = first_rank;
      assigned.push_back(block);
    }
    return;
  }
  const int low_ranks = ranks / 2;
  Target target = target_of_lower(cells_in(blocks), low_ranks, ranks - low_ranks, limit);
  Blocks<Dim> low, high;
  for (const SubBlock<Dim>& block : blocks) {
    const std::size_t size = block.cells.size();
    if (size <= target.ideal) {
      low.push_back(block);
      target = target.less(size);
    } else if (target.ideal > 0) {
      cut_block(block, target, low, high);
      target = {};
    } else {
      high.push_back(block);
    }
  }
  assign(low, first_rank, low_ranks, limit, assigned);
  assign(high, first_rank + low_ranks, ranks - low_ranks, limit, assigned);
}

}  // namespace

template <int Dim>
std::vector<SubBlock<Dim>> bisect_recursively(const MultiblockMesh<Dim>& mesh, int ranks, std::size_t limit) {
  const std::size_t cells = mesh.cell_count();
  const std::size_t n = static_cast<std::size_t>(ranks);
  ensure(ranks > 0 && n <= cells && cells <= n * limit, "no division of the cells satisfies the limit");
  Blocks<Dim> zones, assigned;
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    zones.push_back({static_cast<int>(z), box_of<Dim>(mesh.zones[z].cells), 0});
  assign(zones, 0, ranks, limit, assigned);
  return assigned;
}

template std::vector<SubBlock<2>> bisect_recursively<2>(const MultiblockMesh<2>&, int, std::size_t);
template std::vector<SubBlock<3>> bisect_recursively<3>(const MultiblockMesh<3>&, int, std::size_t);

}  // namespace wingbeat
