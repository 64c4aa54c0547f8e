#pragma once

#include <string>
#include <vector>

#include "core/mesh/block_array.hpp"
#include "core/number/vec.hpp"

namespace wingbeat {

enum class BoundaryType { slip_wall, symmetry, farfield };

// One of the 2 Dim sides of a block: the low (0) or high (1) end of a direction.
struct Side {
  int direction = 0;
  int end = 0;
  friend bool operator==(const Side&, const Side&) = default;
};

// Cells next to a physical boundary: `cells` holds one layer of cells along `side`.
template <int Dim>
struct BoundaryPatch {
  std::string name;
  std::string family;
  BoundaryType type = BoundaryType::farfield;
  Side side;
  Box<Dim> cells;
};

// 1-to-1 connection, stated once for each of the two sides it joins (so that both
// zones list it). Node `index` of this zone is node transform(index) of the donor:
//   donor[axis[d]] = donor_origin[axis[d]] + sign[d] (index[d] - nodes.begin[d]).
template <int Dim>
struct Interface {
  std::string name;
  Side side;
  Box<Dim> nodes;  // node range on this side: extent 1 in side.direction
  int donor = 0;   // zone number
  Side donor_side;
  Index<Dim> donor_origin{};  // donor node that meets nodes.begin
  Index<Dim> axis{};          // donor direction of each direction of this zone
  Index<Dim> sign{};          // +1 or -1
};

// Structured block: nodes (cells + 1 in each direction, no halo), boundary patches, interfaces.
template <int Dim>
struct Zone {
  std::string name;
  Index<Dim> cells{};
  BlockArray<Vec<double, Dim>, Dim> nodes;
  std::vector<BoundaryPatch<Dim>> patches;
  std::vector<Interface<Dim>> interfaces;
};

// Right-handed blocks (positive volumes) whose every side is covered exactly once by
// patches and interfaces. validate() (mesh_check.hpp) establishes both.
template <int Dim>
struct MultiblockMesh {
  std::vector<Zone<Dim>> zones;

  std::size_t cell_count() const {
    std::size_t n = 0;
    for (const auto& zone : zones) n += box_of<Dim>(zone.cells).size();
    return n;
  }
};

// A cell named by its zone, and how the directions of a start zone lie in that zone:
// direction d of the start is direction axis[d] here, reversed where sign[d] < 0.
template <int Dim>
struct CellPosition {
  int zone = 0;
  Index<Dim> cell{};
  Index<Dim> axis{};
  Index<Dim> sign{};
};

template <int Dim>
CellPosition<Dim> start_position(int zone, const Index<Dim>& cell) {
  CellPosition<Dim> position{zone, cell, {}, {}};
  for (int d = 0; d < Dim; ++d) position.axis[d] = d, position.sign[d] = 1;
  return position;
}

// The node of the cell at `position` that is its corner `corner` (0 or 1 in each direction) as the start
// zone sees it.
template <int Dim>
Index<Dim> corner_node(const CellPosition<Dim>& position, const Index<Dim>& corner) {
  Index<Dim> node = position.cell;
  for (int d = 0; d < Dim; ++d) node[position.axis[d]] += position.sign[d] > 0 ? corner[d] : 1 - corner[d];
  return node;
}

// Moves one cell along direction d of the start zone (step = +1 or -1), through interfaces
// of any orientation. Returns false, leaving `position`, at a physical boundary.
template <int Dim>
bool step_to_neighbour(const MultiblockMesh<Dim>& mesh, CellPosition<Dim>& position, int d, int step);

}  // namespace wingbeat
