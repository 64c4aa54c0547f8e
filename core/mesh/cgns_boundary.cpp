#include "core/mesh/cgns_boundary.hpp"

#include <cgnslib.h>

#include <array>
#include <optional>
#include <string>

#include "core/mesh/interface_transform.hpp"
#include "core/mesh/mesh_names.hpp"

namespace wingbeat {
namespace {

using Name = std::array<char, 33>;
// A family may be given by its path, as deep as the library goes.
constexpr std::size_t longest_path = 34 * CG_MAX_GOTO_DEPTH;

// What the file says of one BC_t.
template <int Dim>
struct Condition {
  std::string name;
  std::string family;
  std::string where;  // how messages name it
  CGNS_ENUMT(BCType_t) type{};
  CGNS_ENUMT(GridLocation_t) location{};
  Box<Dim> range;  // counted from 0
};

// The last part of "/Base/Family".
std::string base_name(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

template <int Dim>
Condition<Dim> read_condition(const CgnsFile& file, int base, int zone, int number,
                              const std::string& zone_name) {
  const int fn = file.number();
  Condition<Dim> condition;
  Name name{};
  CGNS_ENUMT(PointSetType_t) points{};
  CGNS_ENUMT(DataType_t) normal_type{};
  cgsize_t point_count = 0;
  cgsize_t normal_size = 0;
  std::array<int, 3> normal_index{};
  int datasets = 0;
  condition.where = fmt::format("zone '{}', boundary condition {}", zone_name, number);
  file.check(cg_boco_info(fn, base, zone, number, name.data(), &condition.type, &points, &point_count,
                          normal_index.data(), &normal_size, &normal_type, &datasets),
             condition.where);
  condition.name = name.data();
  condition.where = fmt::format("zone '{}', patch '{}'", zone_name, condition.name);
  const bool by_element = points == CGNS_ENUMV(ElementRange);
  if ((points != CGNS_ENUMV(PointRange) && !by_element) || point_count != 2)
    file.refuse(fmt::format("{}: its points are given as {}; a structured patch must be given as PointRange",
                            condition.where, cg_PointSetTypeName(points)));

  std::array<cgsize_t, 2 * Dim> range{};
  std::vector<double> normals(static_cast<std::size_t>(normal_size));
  file.check(cg_boco_read(fn, base, zone, number, range.data(), normals.empty() ? nullptr : normals.data()),
             condition.where);
  Index<Dim> a{};
  Index<Dim> b{};
  for (std::size_t d = 0; d < Dim; ++d) a[d] = range[d] - 1, b[d] = range[Dim + d] - 1;
  condition.range = box_between<Dim>(a, b);

  file.check(cg_boco_gridlocation_read(fn, base, zone, number, &condition.location), condition.where);
  if (by_element) condition.location = CGNS_ENUMV(FaceCenter);

  file.check(cg_goto(fn, base, "Zone_t", zone, "ZoneBC_t", 1, "BC_t", number, "end"), condition.where);
  std::array<char, longest_path> family{};
  const int status = cg_famname_read(family.data());
  if (status == CG_OK) condition.family = base_name(family.data());
  if (status != CG_OK && status != CG_NODE_NOT_FOUND) file.check(status, condition.where + ", its family");
  return condition;
}

// The type a family gives its patches.
CGNS_ENUMT(BCType_t)
family_type(const CgnsFile& file, int base, const std::string& family, const std::string& where) {
  int count = 0;
  file.check(cg_nfamilies(file.number(), base, &count), where);
  for (int f = 1; f <= count; ++f) {
    Name name{};
    Name condition{};
    int conditions = 0;
    int geometries = 0;
    CGNS_ENUMT(BCType_t) type{};
    file.check(cg_family_read(file.number(), base, f, name.data(), &conditions, &geometries), where);
    if (family != name.data()) continue;
    if (conditions == 0)
      file.refuse(
          fmt::format("{}: its type is FamilySpecified, but family '{}' has no FamilyBC", where, family));
    file.check(cg_fambc_read(file.number(), base, f, 1, condition.data(), &type), where);
    return type;
  }
  file.refuse(fmt::format("{}: its type is FamilySpecified, but the file has no family '{}'", where, family));
}

BoundaryType boundary_type(const CgnsFile& file, CGNS_ENUMT(BCType_t) type, const std::string& where) {
  switch (type) {
    case CGNS_ENUMV(BCWall):
    case CGNS_ENUMV(BCWallInviscid):
    case CGNS_ENUMV(BCWallViscous):
    case CGNS_ENUMV(BCWallViscousHeatFlux):
    case CGNS_ENUMV(BCWallViscousIsothermal):
      return BoundaryType::slip_wall;
    case CGNS_ENUMV(BCSymmetryPlane):
      return BoundaryType::symmetry;
    case CGNS_ENUMV(BCFarfield):
      return BoundaryType::farfield;
    default:
      file.refuse(
          fmt::format("{}: boundary type {} is not supported; allowed are BCWall, BCWallInviscid, "
                      "BCWallViscous, BCWallViscousHeatFlux, BCWallViscousIsothermal (each a slip wall), "
                      "BCSymmetryPlane and BCFarfield",
                      where, cg_BCTypeName(type)));
  }
}

// The direction a face-centre location names, if it names one.
std::optional<int> named_direction(CGNS_ENUMT(GridLocation_t) location) {
  switch (location) {
    case CGNS_ENUMV(IFaceCenter):
      return 0;
    case CGNS_ENUMV(JFaceCenter):
      return 1;
    case CGNS_ENUMV(KFaceCenter):
      return 2;
    default:
      return std::nullopt;
  }
}

// Sides of the block that the range may lie on: of one index, the first or the last node.
template <int Dim>
std::vector<Side> candidate_sides(const Index<Dim>& cells, const Condition<Dim>& condition) {
  std::vector<Side> sides;
  for (int d = 0; d < Dim; ++d) {
    if (condition.range.extent(d) != 1) continue;
    if (named_direction(condition.location).value_or(d) != d) continue;
    if (condition.range.begin[d] == 0) sides.push_back({d, 0});
    if (condition.range.begin[d] == cells[d]) sides.push_back({d, 1});
  }
  return sides;
}

template <int Dim>
BoundaryPatch<Dim> place(const CgnsFile& file, const Index<Dim>& cells, const Condition<Dim>& condition) {
  const bool by_vertex = condition.location == CGNS_ENUMV(Vertex);
  const bool by_face = condition.location == CGNS_ENUMV(FaceCenter) ||
                       condition.location == CGNS_ENUMV(EdgeCenter) || named_direction(condition.location);
  if (!by_vertex && !by_face)
    file.refuse(fmt::format("{}: grid location {} is not supported; allowed are Vertex and face centres",
                            condition.where, cg_GridLocationName(condition.location)));

  // A patch of vertices spans at least two in every direction of its side; one of faces may be one
  // face wide, so that more than one side is possible: then it is the side it covers wholly.
  std::vector<BoundaryPatch<Dim>> fits;
  std::vector<BoundaryPatch<Dim>> covers;
  for (const Side& side : candidate_sides<Dim>(cells, condition)) {
    const Box<Dim> whole = side_cells<Dim>(cells, side);
    BoundaryPatch<Dim> patch{condition.name, condition.family, {}, side, condition.range};
    if (by_vertex) patch.cells = cells_of_side_nodes<Dim>(cells, side, condition.range);
    patch.cells.begin[side.direction] = whole.begin[side.direction];
    patch.cells.end[side.direction] = whole.end[side.direction];
    if (patch.cells.size() == 0 || !whole.contains(patch.cells.begin) ||
        !whole.contains(last_index(patch.cells)))
      continue;
    fits.push_back(patch);
    if (patch.cells == whole) covers.push_back(patch);
  }
  if (fits.size() == 1) return fits.front();
  if (covers.size() == 1) return covers.front();
  const std::string range = fmt::format("{} to {}", index_text<Dim>(condition.range.begin),
                                        index_text<Dim>(last_index(condition.range)));
  if (fits.empty())
    file.refuse(fmt::format("{}: its range {} is not a face on a side of the zone (degenerate or inside)",
                            condition.where, range));
  file.refuse(
      fmt::format("{}: its range {} of faces may lie on more than one side; give it as a range of "
                  "vertices or say IFaceCenter, JFaceCenter or KFaceCenter",
                  condition.where, range));
}

}  // namespace

template <int Dim>
std::vector<BoundaryPatch<Dim>> read_cgns_boundaries(const CgnsFile& file, int base, int zone,
                                                     const Zone<Dim>& block) {
  int count = 0;
  file.check(cg_nbocos(file.number(), base, zone, &count), fmt::format("zone '{}'", block.name));
  std::vector<BoundaryPatch<Dim>> patches;
  for (int number = 1; number <= count; ++number) {
    Condition<Dim> condition = read_condition<Dim>(file, base, zone, number, block.name);
    if (condition.type == CGNS_ENUMV(FamilySpecified))
      condition.type = family_type(file, base, condition.family, condition.where);
    const BoundaryType type = boundary_type(file, condition.type, condition.where);
    patches.push_back(place<Dim>(file, block.cells, condition));
    patches.back().type = type;
  }
  return patches;
}

template std::vector<BoundaryPatch<2>> read_cgns_boundaries<2>(const CgnsFile&, int, int, const Zone<2>&);
template std::vector<BoundaryPatch<3>> read_cgns_boundaries<3>(const CgnsFile&, int, int, const Zone<3>&);

}  // namespace wingbeat
