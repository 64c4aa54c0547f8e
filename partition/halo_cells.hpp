#pragma once

#include <utility>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// A neighbour of a box of cells, reached by leaving it straight across one side.
template <int Dim>
struct HaloCell {
  Index<Dim> index{};          // in the indices of the box's zone, continued beyond the box
  Side side;                   // side of the box that was crossed
  int layer = 1;               // 1: shares a face with the box
  CellPosition<Dim> position;  // the cell it is, and how the zone's directions lie there
};

// Calls f(HaloCell) for each of the `layers` of neighbours across each side of the box that is
// not at a physical boundary, side by side. Corners are left out.
template <int Dim, class F>
void for_each_halo_cell(const MultiblockMesh<Dim>& mesh, int zone, const Box<Dim>& box, int layers, F&& f) {
  for (int d = 0; d < Dim; ++d)
    for (int end = 0; end < 2; ++end) {
      Box<Dim> inside = box;
      (end == 0 ? inside.end[d] : inside.begin[d]) = end == 0 ? box.begin[d] + 1 : box.end[d] - 1;
      const int step = end == 0 ? -1 : 1;
      for_each(inside, [&](const Index<Dim>& cell) {
        HaloCell<Dim> halo{cell, {d, end}, 1, start_position<Dim>(zone, cell)};
        for (; halo.layer <= layers && step_to_neighbour(mesh, halo.position, d, step); ++halo.layer) {
          halo.index[d] += step;
          f(std::as_const(halo));
        }
      });
    }
}

}  // namespace wingbeat
