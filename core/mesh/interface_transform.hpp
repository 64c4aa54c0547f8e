#pragma once

#include <algorithm>

#include "core/mesh/multiblock_mesh.hpp"

// Index arithmetic of interfaces and sides.
namespace wingbeat {

// Donor node that meets node `index` of this zone.
template <int Dim>
Index<Dim> donor_node(const Interface<Dim>& connection, const Index<Dim>& index) {
  Index<Dim> donor{};
  for (int d = 0; d < Dim; ++d)
    donor[connection.axis[d]] = connection.donor_origin[connection.axis[d]] +
                                connection.sign[d] * (index[d] - connection.nodes.begin[d]);
  return donor;
}

// Smallest box that holds two indices, both included.
template <int Dim>
Box<Dim> box_between(const Index<Dim>& a, const Index<Dim>& b) {
  Box<Dim> box;
  for (int d = 0; d < Dim; ++d) {
    box.begin[d] = std::min(a[d], b[d]);
    box.end[d] = std::max(a[d], b[d]) + 1;
  }
  return box;
}

template <int Dim>
Index<Dim> last_index(const Box<Dim>& box) {
  Index<Dim> last = box.end;
  for (int d = 0; d < Dim; ++d) --last[d];
  return last;
}

// Nodes of the donor that meet connection.nodes.
template <int Dim>
Box<Dim> donor_nodes(const Interface<Dim>& connection) {
  return box_between<Dim>(connection.donor_origin, donor_node<Dim>(connection, last_index(connection.nodes)));
}

// The same connection as the donor states it.
template <int Dim>
Interface<Dim> reversed(const Interface<Dim>& connection, int zone, std::string name) {
  Interface<Dim> reverse;
  reverse.name = std::move(name);
  reverse.side = connection.donor_side;
  reverse.nodes = donor_nodes(connection);
  reverse.donor = zone;
  reverse.donor_side = connection.side;
  for (int d = 0; d < Dim; ++d) {
    const int e = connection.axis[d];
    reverse.axis[e] = d;
    reverse.sign[e] = connection.sign[d];
    reverse.donor_origin[d] = connection.nodes.begin[d] +
                              connection.sign[d] * (reverse.nodes.begin[e] - connection.donor_origin[e]);
  }
  return reverse;
}

// Sign of the direction normal to an interface: sides of the same end meet head on.
inline int normal_sign(const Side& side, const Side& donor_side) {
  return side.end == donor_side.end ? -1 : 1;
}

// The layer of cells along a side of a block.
template <int Dim>
Box<Dim> side_cells(const Index<Dim>& cells, const Side& side) {
  Box<Dim> box = box_of<Dim>(cells);
  box.begin[side.direction] = side.end == 0 ? 0 : cells[side.direction] - 1;
  box.end[side.direction] = box.begin[side.direction] + 1;
  return box;
}

// The cells along a side whose faces have the given nodes.
template <int Dim>
Box<Dim> cells_of_side_nodes(const Index<Dim>& cells, const Side& side, const Box<Dim>& nodes) {
  Box<Dim> box = side_cells<Dim>(cells, side);
  for (int d = 0; d < Dim; ++d)
    if (d != side.direction) box.begin[d] = nodes.begin[d], box.end[d] = nodes.end[d] - 1;
  return box;
}

// The nodes of the faces of a layer of cells along a side.
template <int Dim>
Box<Dim> nodes_of_side_cells(const Index<Dim>& cells, const Side& side, Box<Dim> box) {
  for (int d = 0; d < Dim; ++d) ++box.end[d];
  box.begin[side.direction] = side.end == 0 ? 0 : cells[side.direction];
  box.end[side.direction] = box.begin[side.direction] + 1;
  return box;
}

}  // namespace wingbeat
