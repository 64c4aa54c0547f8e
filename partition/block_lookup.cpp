#include "partition/block_lookup.hpp"

#include <algorithm>
#include <string>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

template <int Dim>
Box<Dim> hull(Box<Dim> a, const Box<Dim>& b) {
  for (int d = 0; d < Dim; ++d) {
    a.begin[d] = std::min(a.begin[d], b.begin[d]);
    a.end[d] = std::max(a.end[d], b.end[d]);
  }
  return a;
}

template <int Dim>
int longest_direction(const Box<Dim>& box) {
  int longest = 0;
  for (int d = 1; d < Dim; ++d)
    if (box.extent(d) > box.extent(longest)) longest = d;
  return longest;
}

}  // namespace

template <int Dim>
BlockLookup<Dim>::BlockLookup(int zones, std::span<const SubBlock<Dim>> blocks) : roots_(zones, -1) {
  std::vector<std::vector<int>> members(zones);
  for (std::size_t b = 0; b < blocks.size(); ++b) members.at(blocks[b].zone).push_back(static_cast<int>(b));
  nodes_.reserve(2 * blocks.size());
  for (int zone = 0; zone < zones; ++zone)
    if (!members[zone].empty()) roots_[zone] = build(blocks, members[zone]);
}

template <int Dim>
int BlockLookup<Dim>::build(std::span<const SubBlock<Dim>> blocks, std::span<int> members) {
  Box<Dim> bounds = blocks[members[0]].cells;
  for (const int b : members) bounds = hull(bounds, blocks[b].cells);
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({bounds, members[0]});
  if (members.size() == 1) return node;

  const int d = longest_direction(bounds);
  const std::size_t half = members.size() / 2;
  std::nth_element(members.begin(), members.begin() + half, members.end(), [&](int a, int b) {
    return std::pair(blocks[a].cells.begin[d] + blocks[a].cells.end[d], a) <
           std::pair(blocks[b].cells.begin[d] + blocks[b].cells.end[d], b);
  });
  const int left = build(blocks, members.first(half));
  const int right = build(blocks, members.subspan(half));
  nodes_[node] = {bounds, -1, left, right};
  return node;
}

template <int Dim>
int BlockLookup<Dim>::descend(int node, const Index<Dim>& cell) const {
  const Node& here = nodes_[node];
  if (!here.bounds.contains(cell)) return -1;
  if (here.block >= 0) return here.block;
  const int found = descend(here.left, cell);
  return found >= 0 ? found : descend(here.right, cell);
}

template <int Dim>
int BlockLookup<Dim>::find(int zone, const Index<Dim>& cell) const {
  const int root = roots_.at(zone);
  const int block = root >= 0 ? descend(root, cell) : -1;
  ensure(block >= 0, "no sub-block of zone " + std::to_string(zone) + " holds a cell of the mesh");
  return block;
}

template class BlockLookup<2>;
template class BlockLookup<3>;

}  // namespace wingbeat
