#pragma once

#include <span>
#include <vector>

#include "partition/partition.hpp"

namespace wingbeat {

// Finds the sub-block that holds a cell: a tree of bounding boxes for each zone, so that a
// query costs the logarithm of the number of sub-blocks.
template <int Dim>
class BlockLookup {
 public:
  BlockLookup(int zones, std::span<const SubBlock<Dim>> blocks);

  // Number of the sub-block in the list given. Throws InternalError when none holds the cell.
  int find(int zone, const Index<Dim>& cell) const;

 private:
  struct Node {
    Box<Dim> bounds;
    int block = -1;  // of a leaf
    int left = -1;
    int right = -1;
  };
  int build(std::span<const SubBlock<Dim>> blocks, std::span<int> members);
  int descend(int node, const Index<Dim>& cell) const;

  std::vector<Node> nodes_;
  std::vector<int> roots_;  // of each zone, -1 where it has no blocks
};

}  // namespace wingbeat
