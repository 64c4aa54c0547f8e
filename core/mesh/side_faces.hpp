#pragma once

#include <span>
#include <vector>

#include "core/mesh/interface_transform.hpp"
#include "core/mesh/multiblock_mesh.hpp"

// The faces on the sides of blocks, and which of them meet: for meshes that come as bare nodes.
namespace wingbeat {

// One face on a side of a block, named by the cell it belongs to.
template <int Dim>
struct SideFace {
  int zone = 0;
  Side side;
  Index<Dim> cell{};
};

// Faces that no patch and no interface covers: zone by zone, side by side, first index fastest.
template <int Dim>
std::vector<SideFace<Dim>> uncovered_faces(const MultiblockMesh<Dim>& mesh);

// The nodes of a face, as a box of extent 2 along the side.
template <int Dim>
Box<Dim> face_nodes(const MultiblockMesh<Dim>& mesh, const SideFace<Dim>& face) {
  const Index<Dim>& cell = face.cell;
  return nodes_of_side_cells<Dim>(mesh.zones[face.zone].cells, face.side, box_between<Dim>(cell, cell));
}

// Length of a face's shortest edge.
template <int Dim>
double shortest_edge(const MultiblockMesh<Dim>& mesh, const SideFace<Dim>& face);

struct IndexPair {
  int first = 0;
  int second = 0;
};

// Pairs of points, first < second, no further apart than the smaller of their tolerances.
// Costs n log n where few points are alike.
template <int Dim>
std::vector<IndexPair> coincident_pairs(std::span<const Vec<double, Dim>> points,
                                        std::span<const double> tolerances);

// Grows a box of side cells from `start` to higher indices, one direction after the other, as long
// as claim(cell) accepts every cell of the next row; release(cell) takes back those of a row that
// is not wholly accepted. `start` is claimed already; cells stay below `limits`.
template <int Dim, class Claim, class Release>
Box<Dim> grow_along_side(const Index<Dim>& start, const Side& side, const Index<Dim>& limits, Claim&& claim,
                         Release&& release) {
  Box<Dim> box = box_between<Dim>(start, start);
  for (int d = 0; d < Dim; ++d) {
    if (d == side.direction) continue;
    bool whole = true;
    while (whole && box.end[d] < limits[d]) {
      Box<Dim> row = box;
      row.begin[d] = box.end[d];
      row.end[d] = box.end[d] + 1;
      std::vector<Index<Dim>> claimed;
      for_each<Dim>(row, [&](const Index<Dim>& cell) {
        whole = whole && claim(cell);
        if (whole) claimed.push_back(cell);
      });
      if (whole)
        ++box.end[d];
      else
        for (const Index<Dim>& cell : claimed) release(cell);
    }
  }
  return box;
}

}  // namespace wingbeat
