#include "core/mesh/cgns_interface.hpp"

#include <cgnslib.h>

#include <array>
#include <cstdlib>

#include "core/mesh/interface_transform.hpp"
#include "core/mesh/mesh_names.hpp"

namespace wingbeat {
namespace {

using Name = std::array<char, 33>;

template <int Dim>
int zone_named(const std::vector<Zone<Dim>>& blocks, const std::string& name) {
  for (std::size_t z = 0; z < blocks.size(); ++z)
    if (blocks[z].name == name) return static_cast<int>(z);
  return -1;
}

// The side that a range of nodes lies on: constant, at one end, in exactly one direction.
template <int Dim>
Side side_of(const CgnsFile& file, const Index<Dim>& cells, const Box<Dim>& nodes, const std::string& where) {
  std::vector<Side> sides;
  int constant = 0;
  for (int d = 0; d < Dim; ++d) {
    if (nodes.extent(d) != 1) continue;
    ++constant;
    if (nodes.begin[d] == 0) sides.push_back({d, 0});
    if (nodes.begin[d] == cells[d]) sides.push_back({d, 1});
  }
  if (constant != 1 || sides.size() != 1)
    file.refuse(fmt::format("{} {} to {} is not a face on a side of the zone (degenerate or inside)", where,
                            index_text<Dim>(nodes.begin), index_text<Dim>(last_index(nodes))));
  return sides.front();
}

template <int Dim>
void set_transform(const CgnsFile& file, const std::array<int, 3>& transform, const std::string& where,
                   Interface<Dim>& connection) {
  Index<Dim> seen{};
  for (std::size_t d = 0; d < Dim; ++d) {
    const int direction = std::abs(transform[d]) - 1;
    if (direction < 0 || direction >= Dim || seen[direction]++ != 0)
      file.refuse(fmt::format("{}: its Transform does not name each direction once", where));
    connection.axis[d] = direction;
    connection.sign[d] = transform[d] > 0 ? 1 : -1;
  }
}

template <int Dim>
Interface<Dim> read_interface(const CgnsFile& file, int base, int zone, int number,
                              const std::vector<Zone<Dim>>& blocks) {
  const Zone<Dim>& block = blocks[zone - 1];
  Name name{};
  std::array<char, 67> donor{};  // "Base/Zone"
  std::array<cgsize_t, 6> range{};
  std::array<cgsize_t, 6> donor_range{};
  std::array<int, 3> transform{};
  file.check(cg_1to1_read(file.number(), base, zone, number, name.data(), donor.data(), range.data(),
                          donor_range.data(), transform.data()),
             fmt::format("zone '{}', interface {}", block.name, number));
  const std::string where = fmt::format("zone '{}', interface '{}'", block.name, name.data());
  std::array<float, 3> unused{};
  if (cg_1to1_periodic_read(file.number(), base, zone, number, unused.data(), unused.data(), unused.data()) ==
      CG_OK)
    file.refuse(where + ": periodic connections are not supported");

  const std::string donor_path = donor.data();
  const std::string donor_name = donor_path.substr(donor_path.find_last_of('/') + 1);
  Interface<Dim> connection;
  connection.name = name.data();
  connection.donor = zone_named(blocks, donor_name);
  if (connection.donor < 0) file.refuse(fmt::format("{}: there is no donor zone '{}'", where, donor_name));
  set_transform(file, transform, where, connection);

  Index<Dim> first{};
  Index<Dim> last{};
  Index<Dim> donor_first{};
  Index<Dim> donor_last{};
  for (std::size_t d = 0; d < Dim; ++d) {
    first[d] = range[d] - 1;
    last[d] = range[Dim + d] - 1;
    donor_first[d] = donor_range[d] - 1;
    donor_last[d] = donor_range[Dim + d] - 1;
  }
  connection.nodes = box_between<Dim>(first, last);
  connection.side = side_of<Dim>(file, block.cells, connection.nodes, where + ": its PointRange");
  const Zone<Dim>& donor_block = blocks[connection.donor];
  connection.donor_side = side_of<Dim>(file, donor_block.cells, box_between<Dim>(donor_first, donor_last),
                                       where + ": its PointRangeDonor");

  // Ranges may run backwards: `first` is what the transform maps to donor_first.
  Interface<Dim> from_first = connection;
  from_first.nodes.begin = first;
  from_first.donor_origin = donor_first;
  const int normal = connection.side.direction;
  if (donor_node<Dim>(from_first, last) != donor_last ||
      connection.axis[normal] != connection.donor_side.direction)
    file.refuse(where + ": its Transform does not carry PointRange to PointRangeDonor");
  connection.donor_origin = donor_node<Dim>(from_first, connection.nodes.begin);
  // Which way the normal runs on follows from the sides; writers differ in the sign they give.
  connection.sign[normal] = normal_sign(connection.side, connection.donor_side);
  return connection;
}

}  // namespace

template <int Dim>
std::vector<Interface<Dim>> read_cgns_interfaces(const CgnsFile& file, int base, int zone,
                                                 const std::vector<Zone<Dim>>& blocks) {
  const std::string where = fmt::format("zone '{}'", blocks[zone - 1].name);
  int general = 0;
  file.check(cg_nconns(file.number(), base, zone, &general), where);
  if (general > 0)
    file.refuse(where +
                ": its general connections (GridConnectivity_t: abutting or overset) are not supported; "
                "write point-matched ones as GridConnectivity1to1_t");
  int count = 0;
  file.check(cg_n1to1(file.number(), base, zone, &count), where);
  std::vector<Interface<Dim>> interfaces;
  for (int number = 1; number <= count; ++number)
    interfaces.push_back(read_interface<Dim>(file, base, zone, number, blocks));
  return interfaces;
}

template std::vector<Interface<2>> read_cgns_interfaces<2>(const CgnsFile&, int, int,
                                                           const std::vector<Zone<2>>&);
template std::vector<Interface<3>> read_cgns_interfaces<3>(const CgnsFile&, int, int,
                                                           const std::vector<Zone<3>>&);

}  // namespace wingbeat
