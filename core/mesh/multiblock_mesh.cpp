#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {
namespace {

template <int Dim>
bool covers(const Interface<Dim>& connection, const Side& side, const Index<Dim>& cell) {
  if (connection.side != side) return false;
  for (int d = 0; d < Dim; ++d)
    if (d != side.direction &&
        (cell[d] < connection.nodes.begin[d] || cell[d] >= connection.nodes.end[d] - 1))
      return false;
  return true;
}

// The donor's cell that shares the face of `cell` on the interface.
template <int Dim>
Index<Dim> cell_across(const MultiblockMesh<Dim>& mesh, const Interface<Dim>& connection,
                       const Index<Dim>& cell) {
  Index<Dim> donor{};
  for (int d = 0; d < Dim; ++d) {
    const int node = connection.donor_origin[connection.axis[d]] +
                     connection.sign[d] * (cell[d] - connection.nodes.begin[d]);
    donor[connection.axis[d]] = connection.sign[d] > 0 ? node : node - 1;
  }
  const Side& side = connection.donor_side;
  donor[side.direction] = side.end == 0 ? 0 : mesh.zones[connection.donor].cells[side.direction] - 1;
  return donor;
}

}  // namespace

template <int Dim>
bool step_to_neighbour(const MultiblockMesh<Dim>& mesh, CellPosition<Dim>& position, int d, int step) {
  const Zone<Dim>& zone = mesh.zones[position.zone];
  const int direction = position.axis[d];
  const int moved = position.cell[direction] + step * position.sign[d];
  if (moved >= 0 && moved < zone.cells[direction]) {
    position.cell[direction] = moved;
    return true;
  }
  const Side side{direction, moved < 0 ? 0 : 1};
  for (const Interface<Dim>& connection : zone.interfaces) {
    if (!covers<Dim>(connection, side, position.cell)) continue;
    CellPosition<Dim> across{connection.donor, cell_across<Dim>(mesh, connection, position.cell), {}, {}};
    for (int e = 0; e < Dim; ++e) {
      across.axis[e] = connection.axis[position.axis[e]];
      across.sign[e] = position.sign[e] * connection.sign[position.axis[e]];
    }
    position = across;
    return true;
  }
  return false;
}

template bool step_to_neighbour<2>(const MultiblockMesh<2>&, CellPosition<2>&, int, int);
template bool step_to_neighbour<3>(const MultiblockMesh<3>&, CellPosition<3>&, int, int);

}  // namespace wingbeat
