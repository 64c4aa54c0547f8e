#include "core/mesh/mesh_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/error.hpp"
#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/interface_transform.hpp"
#include "core/mesh/mesh_names.hpp"

namespace wingbeat {
namespace {

// Faults of one kind in one place, told as one line: the first index and how many there are.
template <int Dim>
struct Occurrences {
  std::size_t count = 0;
  Index<Dim> first{};

  void add(const Index<Dim>& index) {
    if (count++ == 0) first = index;
  }
  std::string more(std::string_view noun) const {
    return count > 1 ? fmt::format(" ({} {} in all)", count, noun) : "";
  }
};

template <int Dim>
bool is_finite(const Vec<double, Dim>& x) {
  return std::all_of(x.components.begin(), x.components.end(), [](double c) { return std::isfinite(c); });
}

template <int Dim>
double shortest_edge_at(const Zone<Dim>& zone, const Index<Dim>& node) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int d = 0; d < Dim; ++d)
    for (int step : {-1, 1}) {
      Index<Dim> next = node;
      next[d] += step;
      if (next[d] < 0 || next[d] > zone.cells[d]) continue;
      shortest = std::min(shortest, norm(zone.nodes(next) - zone.nodes(node)));
    }
  return shortest;
}

// Whether all nodes are finite: nothing else of the zone is worth checking otherwise.
template <int Dim>
bool check_nodes(const Zone<Dim>& zone, std::vector<std::string>& faults) {
  Occurrences<Dim> bad;
  for_each<Dim>(zone.nodes.interior(), [&](const Index<Dim>& node) {
    if (!is_finite<Dim>(zone.nodes(node))) bad.add(node);
  });
  if (bad.count > 0)
    faults.push_back(fmt::format("zone '{}', node {}: coordinates are not finite{}", zone.name,
                                 index_text<Dim>(bad.first), bad.more("nodes")));
  return bad.count == 0;
}

template <int Dim>
void check_volumes(const Zone<Dim>& zone, std::vector<std::string>& faults) {
  Occurrences<Dim> negative;
  Occurrences<Dim> empty;
  double first_negative = 0.0;
  for_each<Dim>(box_of<Dim>(zone.cells), [&](const Index<Dim>& cell) {
    const double volume = cell_volume(cell_corners<Dim>(zone, cell));
    if (volume < 0 && negative.count == 0) first_negative = volume;
    if (volume < 0) negative.add(cell);
    if (volume == 0) empty.add(cell);
  });
  if (negative.count == box_of<Dim>(zone.cells).size())
    faults.push_back(
        fmt::format("zone '{}': every cell has negative volume: the block is left-handed, "
                    "reverse one of its directions",
                    zone.name));
  else if (negative.count > 0)
    faults.push_back(fmt::format("zone '{}', cell {}: negative volume {:.6g}{}", zone.name,
                                 index_text<Dim>(negative.first), first_negative, negative.more("cells")));
  if (empty.count > 0)
    faults.push_back(fmt::format("zone '{}', cell {}: zero volume{}", zone.name, index_text<Dim>(empty.first),
                                 empty.more("cells")));
}

template <int Dim>
bool lies_inside(const Box<Dim>& box, const Box<Dim>& outer) {
  return box.size() > 0 && outer.contains(box.begin) && outer.contains(last_index(box));
}

template <int Dim>
bool is_valid_side(const Side& side) {
  return side.direction >= 0 && side.direction < Dim && (side.end == 0 || side.end == 1);
}

template <int Dim>
bool lies_on_side(const Index<Dim>& cells, const Side& side, const Box<Dim>& nodes) {
  const Box<Dim> all = nodes_of_side_cells<Dim>(cells, side, side_cells<Dim>(cells, side));
  for (int d = 0; d < Dim; ++d)
    if (d != side.direction && nodes.extent(d) < 2) return false;
  return lies_inside(nodes, all);
}

template <int Dim>
bool is_valid_transform(const Interface<Dim>& connection) {
  Index<Dim> seen{};
  for (int d = 0; d < Dim; ++d) {
    if (connection.axis[d] < 0 || connection.axis[d] >= Dim || std::abs(connection.sign[d]) != 1)
      return false;
    if (seen[connection.axis[d]]++ != 0) return false;
  }
  const int normal = connection.side.direction;
  return connection.axis[normal] == connection.donor_side.direction &&
         connection.sign[normal] == normal_sign(connection.side, connection.donor_side);
}

// Whether an interface can be followed at all; says so where it cannot.
template <int Dim>
bool check_placement(const MultiblockMesh<Dim>& mesh, const Zone<Dim>& zone, const Interface<Dim>& connection,
                     std::vector<std::string>& faults) {
  const std::string where = fmt::format("zone '{}', interface '{}': ", zone.name, connection.name);
  if (!is_valid_side<Dim>(connection.side) || !is_valid_side<Dim>(connection.donor_side) ||
      !lies_on_side<Dim>(zone.cells, connection.side, connection.nodes)) {
    faults.push_back(where + "its node range does not lie on a side of the zone");
    return false;
  }
  if (connection.donor < 0 || connection.donor >= static_cast<int>(mesh.zones.size())) {
    faults.push_back(where + "its donor zone does not exist");
    return false;
  }
  if (!is_valid_transform(connection)) {
    faults.push_back(where + "its transform is not a renumbering that joins the two sides");
    return false;
  }
  const Zone<Dim>& donor = mesh.zones[connection.donor];
  if (!lies_on_side<Dim>(donor.cells, connection.donor_side, donor_nodes(connection))) {
    faults.push_back(fmt::format("{}its donor range does not lie on side {} of zone '{}'", where,
                                 to_string(connection.donor_side), donor.name));
    return false;
  }
  return true;
}

template <int Dim>
void check_node_match(const MultiblockMesh<Dim>& mesh, const Zone<Dim>& zone,
                      const Interface<Dim>& connection, std::vector<std::string>& faults) {
  const Zone<Dim>& donor = mesh.zones[connection.donor];
  Occurrences<Dim> apart;
  double widest = 0.0;
  double edge = 0.0;
  for_each<Dim>(connection.nodes, [&](const Index<Dim>& node) {
    const double distance = norm(donor.nodes(donor_node<Dim>(connection, node)) - zone.nodes(node));
    const double local = shortest_edge_at<Dim>(zone, node);
    if (distance <= interface_tolerance * local) return;
    apart.add(node);
    if (distance > widest) widest = distance, edge = local;
  });
  if (apart.count > 0)
    faults.push_back(fmt::format(
        "zone '{}', interface '{}': node {} is not where zone '{}' has node {}; "
        "largest distance {:.3g}, edge there {:.3g}{}",
        zone.name, connection.name, index_text<Dim>(apart.first), donor.name,
        index_text<Dim>(donor_node<Dim>(connection, apart.first)), widest, edge, apart.more("nodes")));
}

// Stepping across every face and back must return to the cell it started from.
template <int Dim>
void check_way_back(const MultiblockMesh<Dim>& mesh, int zone_number, const Interface<Dim>& connection,
                    std::vector<std::string>& faults) {
  const Zone<Dim>& zone = mesh.zones[zone_number];
  const int direction = connection.side.direction;
  const int out = connection.side.end == 0 ? -1 : 1;
  Occurrences<Dim> lost;
  const Box<Dim> cells = cells_of_side_nodes<Dim>(zone.cells, connection.side, connection.nodes);
  for_each<Dim>(cells, [&](const Index<Dim>& cell) {
    CellPosition<Dim> position = start_position<Dim>(zone_number, cell);
    const bool returned = step_to_neighbour(mesh, position, direction, out) &&
                          step_to_neighbour(mesh, position, direction, -out);
    if (!returned || position.zone != zone_number || position.cell != cell) lost.add(cell);
  });
  if (lost.count > 0)
    faults.push_back(
        fmt::format("zone '{}', interface '{}': its donor, zone '{}', does not list the reverse "
                    "connection on side {}, first missing for cell {}{}",
                    zone.name, connection.name, mesh.zones[connection.donor].name,
                    to_string(connection.donor_side), index_text<Dim>(lost.first), lost.more("cells")));
}

// Every face of a side belongs to exactly one patch or interface.
template <int Dim>
void check_cover(const Zone<Dim>& zone, const Side& side, std::vector<std::string>& faults) {
  BlockArray<int, Dim> covers(zone.cells, 0);
  std::string names;
  const auto cover = [&](const std::string& name, const Box<Dim>& cells) {
    names += fmt::format("{}'{}'", names.empty() ? "" : ", ", name);
    for_each<Dim>(cells, [&](const Index<Dim>& cell) { ++covers(cell); });
  };
  for (const BoundaryPatch<Dim>& patch : zone.patches)
    if (patch.side == side && lies_inside(patch.cells, side_cells<Dim>(zone.cells, side)))
      cover(patch.name, patch.cells);
  for (const Interface<Dim>& connection : zone.interfaces)
    if (connection.side == side && lies_on_side<Dim>(zone.cells, side, connection.nodes))
      cover(connection.name, cells_of_side_nodes<Dim>(zone.cells, side, connection.nodes));

  Occurrences<Dim> bare;
  Occurrences<Dim> twice;
  for_each<Dim>(side_cells<Dim>(zone.cells, side), [&](const Index<Dim>& cell) {
    if (covers(cell) == 0) bare.add(cell);
    if (covers(cell) > 1) twice.add(cell);
  });
  const std::string where = fmt::format("zone '{}', side {}, cell ", zone.name, to_string(side));
  if (bare.count > 0)
    faults.push_back(fmt::format("{}{}: no boundary condition and no interface{}", where,
                                 index_text<Dim>(bare.first), bare.more("cells")));
  if (twice.count > 0)
    faults.push_back(fmt::format("{}{}: covered more than once by {}{}", where, index_text<Dim>(twice.first),
                                 names, twice.more("cells")));
}

template <int Dim>
void check_patches(const Zone<Dim>& zone, std::vector<std::string>& faults) {
  for (const BoundaryPatch<Dim>& patch : zone.patches)
    if (!is_valid_side<Dim>(patch.side) || !lies_inside(patch.cells, side_cells<Dim>(zone.cells, patch.side)))
      faults.push_back(fmt::format("zone '{}', patch '{}': its range does not lie on a side of the zone",
                                   zone.name, patch.name));
}

}  // namespace

template <int Dim>
std::vector<std::string> mesh_faults(const MultiblockMesh<Dim>& mesh) {
  std::vector<std::string> faults;
  bool finite = true;
  for (const Zone<Dim>& zone : mesh.zones) {
    for (int d = 0; d < Dim; ++d)
      ensure(zone.cells[d] > 0 && zone.nodes.extents()[d] == zone.cells[d] + 1,
             "nodes do not fit the zone's cells");
    finite = check_nodes(zone, faults) && finite;
  }
  bool placed = true;
  for (const Zone<Dim>& zone : mesh.zones) {
    if (finite) check_volumes(zone, faults);
    check_patches(zone, faults);
    for (const Interface<Dim>& connection : zone.interfaces)
      placed = check_placement(mesh, zone, connection, faults) && placed;
    for (int d = 0; d < Dim; ++d)
      for (int end : {0, 1}) check_cover(zone, Side{d, end}, faults);
  }
  if (!placed || !finite) return faults;
  for (int z = 0; z < static_cast<int>(mesh.zones.size()); ++z)
    for (const Interface<Dim>& connection : mesh.zones[z].interfaces) {
      check_node_match(mesh, mesh.zones[z], connection, faults);
      check_way_back(mesh, z, connection, faults);
    }
  return faults;
}

template <int Dim>
std::vector<std::string> volume_faults(const MultiblockMesh<Dim>& mesh) {
  std::vector<std::string> faults;
  for (const Zone<Dim>& zone : mesh.zones)
    if (check_nodes(zone, faults)) check_volumes(zone, faults);
  return faults;
}

template <int Dim>
void validate(const MultiblockMesh<Dim>& mesh, const std::string& source) {
  constexpr std::size_t listed = 20;
  const std::vector<std::string> faults = mesh_faults(mesh);
  if (faults.empty() && !mesh.zones.empty()) return;
  if (mesh.zones.empty()) throw InputError(source + ": the mesh has no zones");
  std::string message = fmt::format("{}: {} in the mesh (indices count from 1):", source,
                                    faults.size() == 1 ? "1 fault" : fmt::format("{} faults", faults.size()));
  for (std::size_t f = 0; f < std::min(listed, faults.size()); ++f) message += "\n  " + faults[f];
  if (faults.size() > listed) message += fmt::format("\n  ... and {} more", faults.size() - listed);
  throw InputError(message);
}

template std::vector<std::string> mesh_faults<2>(const MultiblockMesh<2>&);
template std::vector<std::string> mesh_faults<3>(const MultiblockMesh<3>&);
template std::vector<std::string> volume_faults<2>(const MultiblockMesh<2>&);
template std::vector<std::string> volume_faults<3>(const MultiblockMesh<3>&);
template void validate<2>(const MultiblockMesh<2>&, const std::string&);
template void validate<3>(const MultiblockMesh<3>&, const std::string&);

}  // namespace wingbeat
