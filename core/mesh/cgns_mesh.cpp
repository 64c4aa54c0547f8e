#include "core/mesh/cgns_mesh.hpp"

#include <cgnslib.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "core/mesh/cgns_boundary.hpp"
#include "core/mesh/cgns_interface.hpp"
#include "core/mesh/collapse_to_2d.hpp"
#include "core/mesh/mesh_check.hpp"
#include "core/mesh/mesh_names.hpp"
#include "core/mesh/reorient.hpp"

namespace wingbeat {
namespace {

using Name = std::array<char, 33>;

// The planes of a surface in space may be off a constant coordinate by this part of its extent.
constexpr double flatness = 1e-6;

struct BaseSize {
  int cell_dim = 0;
  int physical_dim = 0;
};

BaseSize read_base(const CgnsFile& file) {
  int bases = 0;
  file.check(cg_nbases(file.number(), &bases), "bases");
  if (bases != 1) file.refuse(fmt::format("holds {} bases; a mesh has exactly one", bases));
  Name name{};
  BaseSize size;
  file.check(cg_base_read(file.number(), 1, name.data(), &size.cell_dim, &size.physical_dim), "base");
  if (size.cell_dim != 2 && size.cell_dim != 3)
    file.refuse(fmt::format("base '{}': its CellDim is {}; allowed are 2 and 3", name.data(), size.cell_dim));
  return size;
}

template <int Dim>
Zone<Dim> read_zone_size(const CgnsFile& file, int number) {
  Name name{};
  std::array<cgsize_t, 9> size{};
  CGNS_ENUMT(ZoneType_t) type{};
  file.check(cg_zone_read(file.number(), 1, number, name.data(), size.data()),
             fmt::format("zone {}", number));
  file.check(cg_zone_type(file.number(), 1, number, &type), fmt::format("zone '{}'", name.data()));
  if (type != CGNS_ENUMV(Structured))
    file.refuse(fmt::format("zone '{}': is {}; only structured zones are supported", name.data(),
                            cg_ZoneTypeName(type)));
  Zone<Dim> zone;
  zone.name = name.data();
  Index<Dim> nodes{};
  for (std::size_t d = 0; d < Dim; ++d) {
    nodes[d] = size[d];
    zone.cells[d] = size[d] - 1;
    if (zone.cells[d] < 1)
      file.refuse(fmt::format("zone '{}': has {} nodes in direction {}; at least 2 are needed", zone.name,
                              size[d], "ijk"[d]));
  }
  double count = 1.0;
  for (const int n : nodes) count *= static_cast<double>(n);
  file.check_count(count, fmt::format("zone '{}'", zone.name));
  zone.nodes = BlockArray<Vec<double, Dim>, Dim>(nodes, 0);
  return zone;
}

std::set<std::string> coordinate_names(const CgnsFile& file, int zone, const std::string& where) {
  int count = 0;
  file.check(cg_ncoords(file.number(), 1, zone, &count), where);
  std::set<std::string> names;
  for (int c = 1; c <= count; ++c) {
    Name name{};
    CGNS_ENUMT(DataType_t) type{};
    file.check(cg_coord_info(file.number(), 1, zone, c, &type, name.data()), where);
    names.insert(name.data());
  }
  return names;
}

template <int Dim>
std::vector<double> read_coordinate(const CgnsFile& file, int number, const Zone<Dim>& zone,
                                    const std::string& name) {
  std::array<cgsize_t, Dim> first{};
  std::array<cgsize_t, Dim> last{};
  for (std::size_t d = 0; d < Dim; ++d) first[d] = 1, last[d] = zone.cells[d] + 1;
  std::vector<double> values(zone.nodes.interior().size());
  file.check(cg_coord_read(file.number(), 1, number, name.c_str(), CGNS_ENUMV(RealDouble), first.data(),
                           last.data(), values.data()),
             fmt::format("zone '{}', {}", zone.name, name));
  return values;
}

// Whether the values are equal but for rounding, measured by `extent`.
bool is_constant(const std::vector<double>& values, double extent) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low <= flatness * extent;
}

template <int Dim>
void read_coordinates(const CgnsFile& file, int number, int physical_dim, Zone<Dim>& zone) {
  const std::string where = fmt::format("zone '{}'", zone.name);
  const std::set<std::string> present = coordinate_names(file, number, where);
  std::vector<std::vector<double>> values;
  for (int c = 0; c < physical_dim; ++c) {
    const std::string name = fmt::format("Coordinate{}", "XYZ"[c]);
    if (!present.contains(name)) {
      if (present.empty()) file.refuse(where + ": has no coordinates");
      file.refuse(fmt::format("{}: has no {}; it has {}", where, name, fmt::join(present, ", ")));
    }
    values.push_back(read_coordinate<Dim>(file, number, zone, name));
  }
  if (Dim == 2 && physical_dim == 3) {
    double extent = 0.0;
    for (const auto& x : values) {
      const auto [low, high] = std::minmax_element(x.begin(), x.end());
      extent = std::max(extent, *high - *low);
    }
    std::ptrdiff_t dropped = 2;
    while (dropped >= 0 && !is_constant(values[dropped], extent)) --dropped;
    if (dropped < 0)
      file.refuse(where + ": is a surface (CellDim 2) in space, but not in a plane of constant x, y or z");
    values.erase(values.begin() + dropped);
  }
  std::size_t n = 0;
  for_each<Dim>(zone.nodes.interior(), [&](const Index<Dim>& node) {
    for (int c = 0; c < Dim; ++c) zone.nodes(node)[c] = values[c][n];
    ++n;
  });
}

// The zones' ordinals, where every zone has one of its own; else 0, 1, 2, ...
std::vector<int> zone_order(const CgnsFile& file, int count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::vector<int> ordinals(count);
  for (int z = 0; z < count; ++z) {
    file.check(cg_goto(file.number(), 1, "Zone_t", z + 1, "end"), fmt::format("zone {}", z + 1));
    if (cg_ordinal_read(&ordinals[z]) != CG_OK) return order;
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return ordinals[a] < ordinals[b]; });
  return order;
}

// Zones in the given order, donors renumbered.
template <int Dim>
MultiblockMesh<Dim> in_order(std::vector<Zone<Dim>> zones, const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t z = 0; z < order.size(); ++z) place[order[z]] = static_cast<int>(z);
  MultiblockMesh<Dim> mesh;
  for (int z : order) {
    for (Interface<Dim>& connection : zones[z].interfaces) connection.donor = place[connection.donor];
    mesh.zones.push_back(std::move(zones[z]));
  }
  return mesh;
}

template <int Dim>
MultiblockMesh<Dim> read_zones(const CgnsFile& file, int physical_dim) {
  if (physical_dim != 3 && physical_dim != Dim)
    file.refuse(fmt::format("its PhysDim is {} with CellDim {}", physical_dim, Dim));
  int count = 0;
  file.check(cg_nzones(file.number(), 1, &count), "zones");
  if (count == 0) file.refuse("holds no zones");
  std::vector<Zone<Dim>> zones;
  for (int number = 1; number <= count; ++number) zones.push_back(read_zone_size<Dim>(file, number));
  for (int number = 1; number <= count; ++number) {
    Zone<Dim>& zone = zones[number - 1];
    read_coordinates<Dim>(file, number, physical_dim, zone);
    zone.patches = read_cgns_boundaries<Dim>(file, 1, number, zone);
    zone.interfaces = read_cgns_interfaces<Dim>(file, 1, number, zones);
  }
  return in_order(std::move(zones), zone_order(file, count));
}

template <int Dim>
MultiblockMesh<Dim> checked(MultiblockMesh<Dim> mesh, const std::string& source) {
  mesh = make_right_handed(std::move(mesh));
  validate(mesh, source);
  return mesh;
}

}  // namespace

AnyMesh read_cgns(const std::filesystem::path& path) {
  const CgnsFile file = CgnsFile::open(path);
  const BaseSize size = read_base(file);
  if (size.cell_dim == 2) return checked(read_zones<2>(file, size.physical_dim), file.name());
  MultiblockMesh<3> mesh = checked(read_zones<3>(file, size.physical_dim), file.name());
  if (auto plane = collapse_to_2d(mesh, file.name())) return checked(std::move(*plane), file.name());
  return mesh;
}

}  // namespace wingbeat
