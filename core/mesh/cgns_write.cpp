#include <cgnslib.h>

#include <array>
#include <map>
#include <set>

#include "core/io/file.hpp"
#include "core/mesh/cgns_mesh.hpp"
#include "core/mesh/interface_transform.hpp"
#include "core/mesh/mesh_names.hpp"

namespace wingbeat {
namespace {

constexpr std::size_t longest_name = 32;

// Names of the children of one node: each usable and none twice.
class Names {
 public:
  Names(const CgnsFile& file, std::string of) : file_(file), of_(std::move(of)) {}

  const char* add(const std::string& name) {
    if (name.empty() || name.size() > longest_name || name.find('/') != std::string::npos)
      file_.refuse(fmt::format("{}: cannot write the name '{}': CGNS takes 1 to {} characters other than '/'",
                               of_, name, longest_name));
    if (!used_.insert(name).second) file_.refuse(fmt::format("{}: the name '{}' is used twice", of_, name));
    return name.c_str();
  }

 private:
  const CgnsFile& file_;
  std::string of_;
  std::set<std::string> used_;
};

CGNS_ENUMT(BCType_t) cgns_type(BoundaryType type) {
  switch (type) {
    case BoundaryType::slip_wall:
      return CGNS_ENUMV(BCWallInviscid);
    case BoundaryType::symmetry:
      return CGNS_ENUMV(BCSymmetryPlane);
    case BoundaryType::farfield:
      return CGNS_ENUMV(BCFarfield);
  }
  return CGNS_ENUMV(BCTypeNull);
}

// First and last node, counted from 1.
template <int Dim>
std::array<cgsize_t, 2 * Dim> point_range(const Box<Dim>& nodes) {
  std::array<cgsize_t, 2 * Dim> range{};
  for (std::size_t d = 0; d < Dim; ++d) range[d] = nodes.begin[d] + 1, range[Dim + d] = nodes.end[d];
  return range;
}

template <int Dim>
void write_families(const CgnsFile& file, int base, const MultiblockMesh<Dim>& mesh) {
  std::map<std::string, BoundaryType> families;
  for (const Zone<Dim>& zone : mesh.zones)
    for (const BoundaryPatch<Dim>& patch : zone.patches) {
      if (patch.family.empty()) continue;
      const auto [known, is_new] = families.try_emplace(patch.family, patch.type);
      if (known->second != patch.type)
        file.refuse(fmt::format("zone '{}', patch '{}': family '{}' is a {} here and a {} elsewhere",
                                zone.name, patch.name, patch.family, to_string(patch.type),
                                to_string(known->second)));
    }
  Names names(file, "families");
  for (const auto& [family, type] : families) {
    int number = 0;
    int condition = 0;
    file.check(cg_family_write(file.number(), base, names.add(family), &number), "family " + family);
    file.check(cg_fambc_write(file.number(), base, number, "FamBC", cgns_type(type), &condition),
               "family " + family);
  }
}

template <int Dim>
int write_zone(const CgnsFile& file, int base, const Zone<Dim>& zone, Names& zone_names, int ordinal) {
  const std::string where = fmt::format("zone '{}'", zone.name);
  std::array<cgsize_t, 3 * Dim> size{};
  for (std::size_t d = 0; d < Dim; ++d) size[d] = zone.cells[d] + 1, size[Dim + d] = zone.cells[d];
  int number = 0;
  file.check(cg_zone_write(file.number(), base, zone_names.add(zone.name), size.data(),
                           CGNS_ENUMV(Structured), &number),
             where);
  // Readers find zones sorted by name: the ordinal keeps the mesh's order.
  file.check(cg_goto(file.number(), base, "Zone_t", number, "end"), where);
  file.check(cg_ordinal_write(ordinal), where);

  std::vector<double> component(zone.nodes.interior().size());
  for (int c = 0; c < Dim; ++c) {
    std::size_t n = 0;
    for_each<Dim>(zone.nodes.interior(),
                  [&](const Index<Dim>& node) { component[n++] = zone.nodes(node)[c]; });
    int coordinate = 0;
    const std::string name = fmt::format("Coordinate{}", "XYZ"[c]);
    file.check(cg_coord_write(file.number(), base, number, CGNS_ENUMV(RealDouble), name.c_str(),
                              component.data(), &coordinate),
               where + ", " + name);
  }
  return number;
}

template <int Dim>
void write_patches(const CgnsFile& file, int base, int number, const Zone<Dim>& zone) {
  Names names(file, fmt::format("zone '{}', patches", zone.name));
  for (const BoundaryPatch<Dim>& patch : zone.patches) {
    const std::string where = fmt::format("zone '{}', patch '{}'", zone.name, patch.name);
    const auto range = point_range<Dim>(nodes_of_side_cells<Dim>(zone.cells, patch.side, patch.cells));
    const auto type = patch.family.empty() ? cgns_type(patch.type) : CGNS_ENUMV(FamilySpecified);
    int written = 0;
    file.check(cg_boco_write(file.number(), base, number, names.add(patch.name), type, CGNS_ENUMV(PointRange),
                             2, range.data(), &written),
               where);
    if (patch.family.empty()) continue;
    file.check(cg_goto(file.number(), base, "Zone_t", number, "ZoneBC_t", 1, "BC_t", written, "end"), where);
    file.check(cg_famname_write(patch.family.c_str()), where);
  }
}

template <int Dim>
void write_interfaces(const CgnsFile& file, int base, int number, const MultiblockMesh<Dim>& mesh,
                      const Zone<Dim>& zone) {
  Names names(file, fmt::format("zone '{}', interfaces", zone.name));
  for (const Interface<Dim>& connection : zone.interfaces) {
    const auto range = point_range<Dim>(connection.nodes);
    const Index<Dim> last = donor_node<Dim>(connection, last_index(connection.nodes));
    std::array<cgsize_t, 2 * Dim> donor_range{};
    std::array<int, Dim> transform{};
    for (std::size_t d = 0; d < Dim; ++d) {
      donor_range[d] = connection.donor_origin[d] + 1;
      donor_range[Dim + d] = last[d] + 1;
      transform[d] = connection.sign[d] * (connection.axis[d] + 1);
    }
    int written = 0;
    file.check(cg_1to1_write(file.number(), base, number, names.add(connection.name),
                             mesh.zones[connection.donor].name.c_str(), range.data(), donor_range.data(),
                             transform.data(), &written),
               fmt::format("zone '{}', interface '{}'", zone.name, connection.name));
  }
}

}  // namespace

template <int Dim>
int write_cgns_base(const CgnsFile& file, const MultiblockMesh<Dim>& mesh) {
  int base = 0;
  file.check(cg_base_write(file.number(), "Base", Dim, Dim, &base), "base");
  write_families(file, base, mesh);
  Names names(file, "zones");
  int ordinal = 0;
  for (const Zone<Dim>& zone : mesh.zones) {
    const int number = write_zone(file, base, zone, names, ++ordinal);
    write_patches(file, base, number, zone);
    write_interfaces(file, base, number, mesh, zone);
  }
  return base;
}

template <int Dim>
void write_cgns(const MultiblockMesh<Dim>& mesh, const std::filesystem::path& path) {
  AtomicFile target(path);
  CgnsFile file = CgnsFile::create(target.temporary(), path);
  write_cgns_base(file, mesh);
  file.close();
  target.commit();
}

template int write_cgns_base<2>(const CgnsFile&, const MultiblockMesh<2>&);
template int write_cgns_base<3>(const CgnsFile&, const MultiblockMesh<3>&);
template void write_cgns<2>(const MultiblockMesh<2>&, const std::filesystem::path&);
template void write_cgns<3>(const MultiblockMesh<3>&, const std::filesystem::path&);

}  // namespace wingbeat
