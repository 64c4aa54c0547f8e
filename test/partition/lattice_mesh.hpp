#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// How the directions of a zone lie in the lattice: direction d of the zone is direction
// axis[d] of the lattice, reversed where sign[d] < 0.
template <int Dim>
struct LatticeOrientation {
  Index<Dim> axis{};
  Index<Dim> sign{};
};

template <int Dim>
struct LatticeZone {
  Box<Dim> cells;  // of the lattice
  LatticeOrientation<Dim> orientation;
};

// A lattice of cells, closed on itself in its first direction where `closed` (an O-mesh), cut
// into zones of any orientation. It knows every neighbour without asking an interface.
template <int Dim>
class LatticeMesh {
 public:
  LatticeMesh(const Index<Dim>& cells, bool closed, std::vector<LatticeZone<Dim>> zones)
      : cells_(cells), closed_(closed), zones_(std::move(zones)) {
    for (std::size_t z = 0; z < zones_.size(); ++z) mesh_.zones.push_back(make_zone(zones_[z]));
    for (std::size_t a = 0; a < zones_.size(); ++a)
      for (std::size_t b = 0; b < zones_.size(); ++b) connect(static_cast<int>(a), static_cast<int>(b));
    for (std::size_t z = 0; z < zones_.size(); ++z) add_patches(static_cast<int>(z));
  }

  const MultiblockMesh<Dim>& mesh() const { return mesh_; }
  const Index<Dim>& cells() const { return cells_; }

  // Lattice cell of a cell of a zone, not yet wrapped.
  Index<Dim> lattice_cell(int zone, const Index<Dim>& cell) const { return place(zone, cell, 1); }
  Index<Dim> lattice_node(int zone, const Index<Dim>& node) const { return place(zone, node, 0); }

  // Wraps the first direction; false outside the lattice.
  bool wrap(Index<Dim>& cell) const {
    if (closed_) cell[0] = (cell[0] + cells_[0]) % cells_[0];
    return box_of<Dim>(cells_).contains(cell);
  }
  long number(const Index<Dim>& cell) const {
    long n = 0;
    for (int d = Dim - 1; d >= 0; --d) n = n * cells_[d] + cell[d];
    return n;
  }

  // A ring around the origin (closed) or a skewed box, smooth and one-to-one.
  Vec<double, Dim> position(Index<Dim> node) const {
    Vec<double, Dim> x;
    if (closed_) node[0] = (node[0] + cells_[0]) % cells_[0];
    if (closed_) {
      const double angle = 2.0 * std::numbers::pi * node[0] / cells_[0];
      const double radius = 1.0 + 0.3 * node[1] + 0.01 * node[1] * node[1];
      x[0] = radius * std::cos(angle);
      x[1] = -radius * std::sin(angle);  // clockwise, so that (around, outwards) is right-handed
    } else {
      x[0] = node[0] + 0.1 * node[1];
      x[1] = node[1] + 0.02 * node[0] * node[0];
    }
    if constexpr (Dim == 3) x[2] = node[2] + 0.05 * node[0] * (closed_ ? 0.0 : 1.0);
    return x;
  }

 private:
  Index<Dim> place(int zone, const Index<Dim>& index, int from_end) const {
    const auto& [cells, orientation] = zones_[zone];
    Index<Dim> place;
    for (int d = 0; d < Dim; ++d) {
      const int axis = orientation.axis[d];
      place[axis] =
          orientation.sign[d] > 0 ? cells.begin[axis] + index[d] : cells.end[axis] - from_end - index[d];
    }
    return place;
  }

  // Zone index of a lattice node.
  Index<Dim> node_in_zone(const LatticeZone<Dim>& zone, const Index<Dim>& node) const {
    Index<Dim> index;
    for (int d = 0; d < Dim; ++d) {
      const int axis = zone.orientation.axis[d];
      index[d] = zone.orientation.sign[d] > 0 ? node[axis] - zone.cells.begin[axis]
                                              : zone.cells.end[axis] - node[axis];
    }
    return index;
  }

  Zone<Dim> make_zone(const LatticeZone<Dim>& lattice_zone) {
    Zone<Dim> zone;
    Index<Dim> nodes;
    for (int d = 0; d < Dim; ++d) {
      zone.cells[d] = lattice_zone.cells.extent(lattice_zone.orientation.axis[d]);
      nodes[d] = zone.cells[d] + 1;
    }
    zone.name = "zone-" + std::to_string(mesh_.zones.size());
    zone.nodes = BlockArray<Vec<double, Dim>, Dim>(nodes, 0);
    const int number = static_cast<int>(mesh_.zones.size());
    for_each(box_of<Dim>(nodes),
             [&](const Index<Dim>& node) { zone.nodes(node) = position(lattice_node(number, node)); });
    return zone;
  }

  static int direction_along(const LatticeOrientation<Dim>& orientation, int axis) {
    int d = 0;
    while (orientation.axis[d] != axis) ++d;
    return d;
  }
  static Side side_of(const LatticeOrientation<Dim>& orientation, int axis, int end) {
    const int d = direction_along(orientation, axis);
    return {d, orientation.sign[d] > 0 ? end : 1 - end};
  }

  // Interfaces of zone a with zone b, across every lattice plane where they touch.
  void connect(int a, int b) {
    const LatticeZone<Dim>&za = zones_[a], &zb = zones_[b];
    for (int axis = 0; axis < Dim; ++axis)
      for (int end = 0; end < 2; ++end) {
        const int plane = end == 0 ? za.cells.begin[axis] : za.cells.end[axis];
        int plane_b = plane;
        if (closed_ && axis == 0 && plane == (end == 0 ? 0 : cells_[0])) plane_b = cells_[0] - plane;
        if ((end == 0 ? zb.cells.end[axis] : zb.cells.begin[axis]) != plane_b) continue;
        if (a == b && plane == plane_b) continue;
        Box<Dim> shared;  // lattice nodes
        bool touch = true;
        for (int d = 0; d < Dim; ++d) {
          shared.begin[d] = d == axis ? plane : std::max(za.cells.begin[d], zb.cells.begin[d]);
          shared.end[d] = d == axis ? plane : std::min(za.cells.end[d], zb.cells.end[d]);
          touch = touch && (d == axis || shared.begin[d] < shared.end[d]);
        }
        if (touch) add_interface(a, b, axis, end, shared, plane_b);
      }
  }

  void add_interface(int a, int b, int axis, int end, const Box<Dim>& shared, int plane_b) {
    const LatticeZone<Dim>&za = zones_[a], &zb = zones_[b];
    Interface<Dim> interface;
    interface.name = std::to_string(a) + "-" + std::to_string(b);
    interface.side = side_of(za.orientation, axis, end);
    interface.donor = b;
    interface.donor_side = side_of(zb.orientation, axis, 1 - end);
    const Index<Dim> p = node_in_zone(za, shared.begin), q = node_in_zone(za, shared.end);
    for (int d = 0; d < Dim; ++d) {
      interface.nodes.begin[d] = std::min(p[d], q[d]);
      interface.nodes.end[d] = std::max(p[d], q[d]) + 1;
      interface.axis[d] = direction_along(zb.orientation, za.orientation.axis[d]);
      interface.sign[d] = za.orientation.sign[d] * zb.orientation.sign[interface.axis[d]];
    }
    Index<Dim> first = lattice_node(a, interface.nodes.begin);
    first[axis] = plane_b;
    interface.donor_origin = node_in_zone(zb, first);
    mesh_.zones[a].interfaces.push_back(interface);
  }

  void add_patches(int z) {
    const auto& [cells, orientation] = zones_[z];
    for (int axis = 0; axis < Dim; ++axis)
      for (int end = 0; end < 2; ++end) {
        const bool outer = end == 0 ? cells.begin[axis] == 0 : cells.end[axis] == cells_[axis];
        if (!outer || (closed_ && axis == 0)) continue;
        BoundaryPatch<Dim> patch;
        patch.side = side_of(orientation, axis, end);
        patch.type = axis == 1 && end == 0 ? BoundaryType::slip_wall : BoundaryType::farfield;
        patch.name = std::to_string(z) + (end == 0 ? "-low-" : "-high-") + std::to_string(axis);
        patch.family = patch.type == BoundaryType::slip_wall ? "wall" : "farfield";
        patch.cells = box_of<Dim>(mesh_.zones[z].cells);
        const int d = patch.side.direction;
        (patch.side.end == 0 ? patch.cells.end[d] : patch.cells.begin[d]) =
            patch.side.end == 0 ? 1 : patch.cells.end[d] - 1;
        mesh_.zones[z].patches.push_back(patch);
      }
  }

  Index<Dim> cells_;
  bool closed_;
  std::vector<LatticeZone<Dim>> zones_;
  MultiblockMesh<Dim> mesh_;
};

inline LatticeMesh<2> single_ring(int around, int outwards) {
  return {{around, outwards}, true, {{{{0, 0}, {around, outwards}}, {{0, 1}, {1, 1}}}}};
}

// An O-mesh in five zones: reversed, permuted, one a single cell thick, one with a T-junction.
inline LatticeMesh<2> turned_ring() {
  return {{20, 9},
          true,
          {{{{0, 0}, {7, 9}}, {{0, 1}, {1, 1}}},
           {{{7, 0}, {12, 4}}, {{1, 0}, {1, -1}}},
           {{{7, 4}, {12, 9}}, {{0, 1}, {-1, -1}}},
           {{{12, 0}, {13, 9}}, {{1, 0}, {-1, 1}}},
           {{{13, 0}, {20, 9}}, {{0, 1}, {-1, -1}}}}};
}

// A box and a ring in 3-D, every zone turned another way.
inline LatticeMesh<3> turned_box() {
  return {{9, 7, 6},
          false,
          {{{{0, 0, 0}, {4, 7, 6}}, {{0, 1, 2}, {1, 1, 1}}},
           {{{4, 0, 0}, {9, 3, 6}}, {{1, 2, 0}, {1, 1, 1}}},
           {{{4, 3, 0}, {9, 7, 1}}, {{2, 1, 0}, {-1, 1, 1}}},
           {{{4, 3, 1}, {9, 7, 6}}, {{0, 2, 1}, {1, -1, 1}}}}};
}
inline LatticeMesh<3> turned_shell() {
  return {{12, 4, 5},
          true,
          {{{{0, 0, 0}, {5, 4, 5}}, {{2, 0, 1}, {1, 1, 1}}},
           {{{5, 0, 0}, {12, 4, 2}}, {{0, 1, 2}, {-1, -1, 1}}},
           {{{5, 0, 2}, {12, 4, 5}}, {{1, 0, 2}, {-1, 1, 1}}}}};
}

}  // namespace wingbeat
