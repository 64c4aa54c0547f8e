#include "partition/split_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

namespace wingbeat {
namespace {

template <int Dim>
void split_recursively(const Box<Dim>& box, int pieces, std::vector<Box<Dim>>& parts) {
  const int d = directions_by_extent(box)[0];
  if (pieces <= 1 || box.extent(d) <= 1) {
    parts.push_back(box);
    return;
  }
  const int low_pieces = pieces / 2;
  const double share = static_cast<double>(low_pieces) / pieces;
  const auto [low, high] = cut_at(box, d, cut_plane(box.begin[d], box.end[d], share));
  split_recursively(low, low_pieces, parts);
  split_recursively(high, pieces - low_pieces, parts);
}

// Key by which blocks that can be joined along direction d become neighbours in a sorted list.
template <int Dim>
std::array<int, 2 * Dim + 1> order_along(const SubBlock<Dim>& block, int d) {
  std::array<int, 2 * Dim + 1> key{block.rank, block.zone};
  int n = 2;
  for (int e = 0; e < Dim; ++e) {
    if (e == d) continue;
    key[n++] = block.cells.begin[e];
    key[n++] = block.cells.end[e];
  }
  key[n] = block.cells.begin[d];
  return key;
}

template <int Dim>
bool joins(const SubBlock<Dim>& low, const SubBlock<Dim>& high, int d) {
  if (low.rank != high.rank || low.zone != high.zone || low.cells.end[d] != high.cells.begin[d]) return false;
  for (int e = 0; e < Dim; ++e)
    if (e != d && (low.cells.begin[e] != high.cells.begin[e] || low.cells.end[e] != high.cells.end[e]))
      return false;
  return true;
}

template <int Dim>
void merge_along(std::vector<SubBlock<Dim>>& blocks, int d) {
  std::ranges::sort(blocks, {}, [d](const SubBlock<Dim>& block) { return order_along(block, d); });
  std::vector<SubBlock<Dim>> merged;
  merged.reserve(blocks.size());
  for (const SubBlock<Dim>& block : blocks) {
    if (!merged.empty() && joins(merged.back(), block, d))
      merged.back().cells.end[d] = block.cells.end[d];
    else
      merged.push_back(block);
  }
  blocks = std::move(merged);
}

}  // namespace

int cut_plane(int begin, int end, double share) {
  const double ideal = begin + (end - begin) * share;
  const int below = static_cast<int>(std::floor(ideal));
  const bool exact = ideal == static_cast<double>(below);
  const int plane = exact || below % 2 == 0 ? below : below + 1;
  return std::clamp(plane, begin + 1, end - 1);
}

template <int Dim>
std::pair<Box<Dim>, Box<Dim>> cut_at(const Box<Dim>& box, int d, int cut) {
  Box<Dim> low = box, high = box;
  low.end[d] = high.begin[d] = cut;
  return {low, high};
}

template <int Dim>
Index<Dim> directions_by_extent(const Box<Dim>& box) {
  Index<Dim> directions;
  for (int d = 0; d < Dim; ++d) directions[d] = d;
  std::ranges::stable_sort(directions, std::greater{}, [&](int d) { return box.extent(d); });
  return directions;
}

template <int Dim>
std::vector<Box<Dim>> split_box(const Box<Dim>& box, int pieces) {
  std::vector<Box<Dim>> parts;
  split_recursively(box, pieces, parts);
  return parts;
}

template <int Dim>
std::vector<SubBlock<Dim>> merge_blocks(std::vector<SubBlock<Dim>> blocks) {
  for (std::size_t before = blocks.size() + 1; blocks.size() < before;) {
    before = blocks.size();
    for (int d = 0; d < Dim; ++d) merge_along(blocks, d);
  }
  std::ranges::sort(blocks, {}, [](const SubBlock<Dim>& block) {
    Index<Dim> place = block.cells.begin;
    std::ranges::reverse(place);
    return std::tuple(block.rank, block.zone, place);
  });
  return blocks;
}

template std::pair<Box<2>, Box<2>> cut_at<2>(const Box<2>&, int, int);
template std::pair<Box<3>, Box<3>> cut_at<3>(const Box<3>&, int, int);
template Index<2> directions_by_extent<2>(const Box<2>&);
template Index<3> directions_by_extent<3>(const Box<3>&);
template std::vector<Box<2>> split_box<2>(const Box<2>&, int);
template std::vector<Box<3>> split_box<3>(const Box<3>&, int);
template std::vector<SubBlock<2>> merge_blocks<2>(std::vector<SubBlock<2>>);
template std::vector<SubBlock<3>> merge_blocks<3>(std::vector<SubBlock<3>>);

}  // namespace wingbeat
