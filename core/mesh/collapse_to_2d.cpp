#include "core/mesh/collapse_to_2d.hpp"

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"
#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/interface_transform.hpp"
#include "core/mesh/mesh_names.hpp"

namespace wingbeat {
namespace {

// Largest distance, relative to the thickness, by which the two planes may fail to be flat or alike.
constexpr double plane_tolerance = 1e-6;

// The two directions other than `dropped`, in order.
Index<2> kept_directions(int dropped) { return {dropped == 0 ? 1 : 0, dropped == 2 ? 1 : 2}; }

bool is_symmetry_side(const Zone<3>& zone, const Side& side) {
  std::size_t covered = 0;
  for (const BoundaryPatch<3>& patch : zone.patches)
    if (patch.side == side && patch.type == BoundaryType::symmetry) covered += patch.cells.size();
  return covered == side_cells<3>(zone.cells, side).size();
}

// The direction of one cell between two symmetry planes; -1 where there is none.
int thin_direction(const Zone<3>& zone) {
  for (int d : {2, 1, 0})
    if (zone.cells[d] == 1 && is_symmetry_side(zone, {d, 0}) && is_symmetry_side(zone, {d, 1})) return d;
  return -1;
}

// The coordinate in which the two planes of a zone differ.
int span_coordinate(const Zone<3>& zone, int thin) {
  Index<3> far{};
  far[thin] = 1;
  const Vec<double, 3> span = zone.nodes(far) - zone.nodes(Index<3>{});
  int largest = 0;
  for (int c : {1, 2})
    if (std::abs(span[c]) > std::abs(span[largest])) largest = c;
  return largest;
}

Index<2> without(const Index<3>& index, int dropped) {
  const Index<2> kept = kept_directions(dropped);
  return {index[kept[0]], index[kept[1]]};
}

Box<2> without(const Box<3>& box, int dropped) {
  return {without(box.begin, dropped), without(box.end, dropped)};
}

int direction_without(int direction, int dropped) { return direction > dropped ? direction - 1 : direction; }

Side without(const Side& side, int dropped) { return {direction_without(side.direction, dropped), side.end}; }

BlockArray<Vec<double, 2>, 2> plane_nodes(const Zone<3>& zone, int thin, int span,
                                          const std::string& source) {
  const Index<2> directions = kept_directions(thin);
  const Index<2> coordinates = kept_directions(span);
  Index<3> far{};
  far[thin] = 1;
  const double low = zone.nodes(Index<3>{})[span];
  const double high = zone.nodes(far)[span];
  BlockArray<Vec<double, 2>, 2> plane(without(zone.nodes.extents(), thin), 0);
  for_each<2>(plane.interior(), [&](const Index<2>& node) {
    Index<3> a{};
    for (std::size_t d = 0; d < 2; ++d) a[directions[d]] = node[d];
    Index<3> b = a;
    b[thin] = 1;
    Vec<double, 3> difference = zone.nodes(b) - zone.nodes(a);
    difference[span] = std::max(std::abs(zone.nodes(a)[span] - low), std::abs(zone.nodes(b)[span] - high));
    if (norm(difference) > plane_tolerance * std::abs(high - low))
      throw InputError(
          fmt::format("{}: zone '{}', node {}: the mesh is one cell thick between two symmetry planes, but "
                      "the planes are "
                      "not two equal sections at constant {} (off by {:.3g}); a 2-D mesh needs an unswept, "
                      "untapered extrusion",
                      source, zone.name, index_text<3>(a), "xyz"[span], norm(difference)));
    plane(node) = {{{zone.nodes(a)[coordinates[0]], zone.nodes(a)[coordinates[1]]}}};
  });
  return plane;
}

Interface<2> collapsed(const Interface<3>& connection, int thin, int donor_thin) {
  Interface<2> result;
  result.name = connection.name;
  result.side = without(connection.side, thin);
  result.nodes = without(connection.nodes, thin);
  result.donor = connection.donor;
  result.donor_side = without(connection.donor_side, donor_thin);
  result.donor_origin = without(connection.donor_origin, donor_thin);
  for (int kept = 0; kept < 2; ++kept) {
    const int d = kept < thin ? kept : kept + 1;
    result.axis[kept] = direction_without(connection.axis[d], donor_thin);
    result.sign[kept] = connection.sign[d];
  }
  return result;
}

Zone<2> collapsed(const Zone<3>& zone, const std::vector<int>& thin, int own, int span,
                  const std::string& source) {
  Zone<2> result;
  result.name = zone.name;
  result.cells = without(zone.cells, own);
  result.nodes = plane_nodes(zone, own, span, source);
  for (const BoundaryPatch<3>& patch : zone.patches)
    if (patch.side.direction != own)
      result.patches.push_back(
          {patch.name, patch.family, patch.type, without(patch.side, own), without(patch.cells, own)});
  for (const Interface<3>& connection : zone.interfaces) {
    const int donor_thin = thin[connection.donor];
    if (connection.axis[own] != donor_thin)
      throw InputError(fmt::format("{}: zone '{}', interface '{}': does not join the spans of the two zones",
                                   source, zone.name, connection.name));
    result.interfaces.push_back(collapsed(connection, own, donor_thin));
  }
  return result;
}

}  // namespace

std::optional<MultiblockMesh<2>> collapse_to_2d(const MultiblockMesh<3>& mesh, const std::string& source) {
  std::vector<int> thin;
  for (const Zone<3>& zone : mesh.zones) thin.push_back(thin_direction(zone));
  if (mesh.zones.empty() || std::count(thin.begin(), thin.end(), -1) > 0) return std::nullopt;

  const int span = span_coordinate(mesh.zones.front(), thin.front());
  MultiblockMesh<2> result;
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    result.zones.push_back(collapsed(mesh.zones[z], thin, thin[z], span, source));
  return result;
}

}  // namespace wingbeat
