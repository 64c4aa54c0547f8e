#include "core/mesh/reorient.hpp"

#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/interface_transform.hpp"

namespace wingbeat {
namespace {

// Maps indices 0..extents[d]-1 of the old numbering to the new one.
template <int Dim>
Index<Dim> renumbered(const Orientation<Dim>& o, const Index<Dim>& extents, const Index<Dim>& index) {
  Index<Dim> result{};
  for (int d = 0; d < Dim; ++d) result[o.axis[d]] = o.sign[d] > 0 ? index[d] : extents[d] - 1 - index[d];
  return result;
}

template <int Dim>
Box<Dim> renumbered(const Orientation<Dim>& o, const Index<Dim>& extents, const Box<Dim>& box) {
  return box_between<Dim>(renumbered<Dim>(o, extents, box.begin),
                          renumbered<Dim>(o, extents, last_index(box)));
}

template <int Dim>
Side renumbered(const Orientation<Dim>& o, const Side& side) {
  return {o.axis[side.direction], o.sign[side.direction] > 0 ? side.end : 1 - side.end};
}

// The interface after its own zone has been renumbered.
template <int Dim>
Interface<Dim> own_side_renumbered(const Orientation<Dim>& o, const Index<Dim>& node_extents,
                                   const Interface<Dim>& old) {
  Interface<Dim> result = old;
  result.side = renumbered(o, old.side);
  result.nodes = renumbered<Dim>(o, node_extents, old.nodes);
  Index<Dim> first = old.nodes.begin;  // old node that now comes first
  for (int d = 0; d < Dim; ++d) {
    if (o.sign[d] < 0) first[d] = old.nodes.end[d] - 1;
    result.axis[o.axis[d]] = old.axis[d];
    result.sign[o.axis[d]] = old.sign[d] * o.sign[d];
  }
  result.donor_origin = donor_node<Dim>(old, first);
  return result;
}

// The interface after its donor zone has been renumbered.
template <int Dim>
Interface<Dim> donor_side_renumbered(const Orientation<Dim>& o, const Index<Dim>& node_extents,
                                     const Interface<Dim>& old) {
  Interface<Dim> result = old;
  result.donor_side = renumbered(o, old.donor_side);
  result.donor_origin = renumbered<Dim>(o, node_extents, old.donor_origin);
  for (int d = 0; d < Dim; ++d) {
    result.axis[d] = o.axis[old.axis[d]];
    result.sign[d] = old.sign[d] * o.sign[old.axis[d]];
  }
  return result;
}

template <int Dim>
bool is_left_handed(const Zone<Dim>& zone) {
  long balance = 0;
  for_each<Dim>(box_of<Dim>(zone.cells), [&](const Index<Dim>& cell) {
    const double volume = cell_volume(cell_corners<Dim>(zone, cell));
    balance += (volume > 0) - (volume < 0);
  });
  return balance < 0;
}

}  // namespace

template <int Dim>
MultiblockMesh<Dim> reoriented(MultiblockMesh<Dim> mesh, int zone_number, const Orientation<Dim>& o) {
  Zone<Dim>& zone = mesh.zones[zone_number];
  const Index<Dim> cells = zone.cells;
  const Index<Dim> nodes = zone.nodes.extents();
  Index<Dim> new_nodes{};
  for (int d = 0; d < Dim; ++d) new_nodes[o.axis[d]] = nodes[d], zone.cells[o.axis[d]] = cells[d];

  BlockArray<Vec<double, Dim>, Dim> coordinates(new_nodes, 0);
  for_each<Dim>(box_of<Dim>(nodes), [&](const Index<Dim>& node) {
    coordinates(renumbered<Dim>(o, nodes, node)) = zone.nodes(node);
  });
  zone.nodes = std::move(coordinates);

  for (BoundaryPatch<Dim>& patch : zone.patches) {
    patch.side = renumbered(o, patch.side);
    patch.cells = renumbered<Dim>(o, cells, patch.cells);
  }
  for (Interface<Dim>& connection : zone.interfaces)
    connection = own_side_renumbered<Dim>(o, nodes, connection);
  for (Zone<Dim>& other : mesh.zones)
    for (Interface<Dim>& connection : other.interfaces)
      if (connection.donor == zone_number) connection = donor_side_renumbered<Dim>(o, nodes, connection);
  return mesh;
}

template <int Dim>
MultiblockMesh<Dim> make_right_handed(MultiblockMesh<Dim> mesh) {
  Orientation<Dim> reversal;
  for (int d = 0; d < Dim; ++d) reversal.axis[d] = d, reversal.sign[d] = d == 0 ? -1 : 1;
  for (int zone = 0; zone < static_cast<int>(mesh.zones.size()); ++zone)
    if (is_left_handed(mesh.zones[zone])) mesh = reoriented(std::move(mesh), zone, reversal);
  return mesh;
}

template MultiblockMesh<2> reoriented<2>(MultiblockMesh<2>, int, const Orientation<2>&);
template MultiblockMesh<3> reoriented<3>(MultiblockMesh<3>, int, const Orientation<3>&);
template MultiblockMesh<2> make_right_handed<2>(MultiblockMesh<2>);
template MultiblockMesh<3> make_right_handed<3>(MultiblockMesh<3>);

}  // namespace wingbeat
