#include <cgnslib.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/mesh/cgns_file.hpp"
#include "core/mesh/solution_file.hpp"
#include "core/mesh/solution_layout.hpp"

namespace wingbeat {
namespace {

using namespace solution_layout;

// Number of the zone called `name` in the file.
template <int Dim>
int find_zone(const CgnsFile& file, const Zone<Dim>& zone) {
  int count = 0;
  file.check(cg_nzones(file.number(), 1, &count), "zones");
  for (int number = 1; number <= count; ++number) {
    Name name{};
    std::array<cgsize_t, 9> size{};
    file.check(cg_zone_read(file.number(), 1, number, name.data(), size.data()), "zones");
    if (zone.name != name.data()) continue;
    for (std::size_t d = 0; d < Dim; ++d)
      if (size[d] != zone.cells[d] + 1)
        file.refuse(fmt::format("zone '{}': has {} nodes in direction {}, the mesh has {}", zone.name,
                                size[d], "ijk"[d], zone.cells[d] + 1));
    return number;
  }
  file.refuse(fmt::format("has no zone '{}': it is the solution of another mesh", zone.name));
}

// Number of the child of a zone that `read_name` calls `name`.
template <class ReadName>
int find_child(const CgnsFile& file, int count, const std::string& name, const std::string& where,
               ReadName&& read_name) {
  for (int number = 1; number <= count; ++number) {
    Name found{};
    file.check(read_name(number, found.data()), where);
    if (name == found.data()) return number;
  }
  file.refuse(fmt::format("{}: has no {}; the file is not a solution of this program", where, name));
}

template <int Dim>
std::vector<SolutionField> read_flow(const CgnsFile& file, int number, const Zone<Dim>& zone,
                                     const std::string& name) {
  const std::string where = fmt::format("zone '{}'", zone.name);
  const int fn = file.number();
  int count = 0;
  file.check(cg_nsols(fn, 1, number, &count), where);
  CGNS_ENUMT(GridLocation_t) location{};
  const int flow = find_child(file, count, name, where, [&](int s, char* found) {
    return cg_sol_info(fn, 1, number, s, found, &location);
  });
  if (location != CGNS_ENUMV(CellCenter))
    file.refuse(fmt::format("{}, {}: is not given at cell centres", where, name));
  int field_count = 0;
  file.check(cg_nfields(fn, 1, number, flow, &field_count), where);
  std::array<cgsize_t, Dim> first{};
  first.fill(1);
  std::array<cgsize_t, Dim> last{};
  for (std::size_t d = 0; d < Dim; ++d) last[d] = zone.cells[d];
  std::vector<SolutionField> fields;
  for (int f = 1; f <= field_count; ++f) {
    Name field{};
    CGNS_ENUMT(DataType_t) type{};
    file.check(cg_field_info(fn, 1, number, flow, f, &type, field.data()), where);
    fields.push_back({field.data(), std::vector<double>(box_of<Dim>(zone.cells).size())});
    file.check(cg_field_read(fn, 1, number, flow, field.data(), CGNS_ENUMV(RealDouble), first.data(),
                             last.data(), fields.back().values.data()),
               where + ", " + fields.back().name);
  }
  return fields;
}

// An array of the current node, by name; empty where there is none.
std::vector<double> read_array(const CgnsFile& file, const std::string& name, const std::string& where) {
  int count = 0;
  file.check(cg_narrays(&count), where);
  for (int a = 1; a <= count; ++a) {
    Name found{};
    CGNS_ENUMT(DataType_t) type{};
    int dimension = 0;
    std::array<cgsize_t, 12> size{};
    file.check(cg_array_info(a, found.data(), &type, &dimension, size.data()), where);
    if (name != found.data()) continue;
    double length = 1.0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
      length *= std::max(0.0, static_cast<double>(size[d]));
    file.check_count(length, where + ", " + name);
    std::vector<double> values(static_cast<std::size_t>(length));
    file.check(cg_array_read_as(a, CGNS_ENUMV(RealDouble), values.data()), where + ", " + name);
    return values;
  }
  return {};
}

template <int Dim>
std::vector<Vec<double, Dim>> read_grid(const CgnsFile& file, int number, const Zone<Dim>& zone,
                                        const std::string& name) {
  const std::string where = fmt::format("zone '{}', {}", zone.name, name);
  int count = 0;
  file.check(cg_ngrids(file.number(), 1, number, &count), where);
  const int grid = find_child(file, count, name, where, [&](int g, char* found) {
    return cg_grid_read(file.number(), 1, number, g, found);
  });
  file.check(cg_goto(file.number(), 1, "Zone_t", number, "GridCoordinates_t", grid, "end"), where);
  std::vector<Vec<double, Dim>> nodes(zone.nodes.interior().size());
  for (int c = 0; c < Dim; ++c) {
    const std::vector<double> component = read_array(file, coordinate_name(c), where);
    if (component.size() != nodes.size())
      file.refuse(fmt::format("{}: {} is missing", where, coordinate_name(c)));
    for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n][c] = component[n];
  }
  return nodes;
}

std::vector<double> read_times(const CgnsFile& file) {
  Name name{};
  int steps = 0;
  if (cg_biter_read(file.number(), 1, name.data(), &steps) != CG_OK)
    file.refuse("holds no solution (no BaseIterativeData)");
  file.check(cg_goto(file.number(), 1, "BaseIterativeData_t", 1, "end"), "times");
  std::vector<double> times = read_array(file, "TimeValues", "times");
  if (times.empty() || times.size() != static_cast<std::size_t>(steps))
    file.refuse("TimeValues of BaseIterativeData are missing or do not fit its steps");
  return times;
}

// `data` and `text` of a solution, and what the file says its sum is (empty in one of an earlier version).
template <int Dim>
std::string read_restart_data(const CgnsFile& file, Solution<Dim>& solution) {
  if (cg_goto(file.number(), 1, restart_node, 0, "end") != CG_OK) return "";
  int count = 0;
  file.check(cg_narrays(&count), restart_node);
  for (int a = 1; a <= count; ++a) {
    Name name{};
    CGNS_ENUMT(DataType_t) type{};
    int dimension = 0;
    std::array<cgsize_t, 12> size{};
    file.check(cg_array_info(a, name.data(), &type, &dimension, size.data()), restart_node);
    if (type == CGNS_ENUMV(Character)) {
      std::string text(static_cast<std::size_t>(size[0]), '\0');
      file.check(cg_array_read(a, text.data()), restart_node);
      solution.text[name.data()] = std::move(text);
    } else {
      solution.data[name.data()] = read_array(file, name.data(), restart_node);
    }
  }
  if (const auto found = solution.data.extract(format_name)) {
    const double number = found.mapped().empty() ? 0.0 : found.mapped()[0];
    if (number != format)
      file.refuse(
          fmt::format("its format has the number {}, this version reads {}: continue with the version "
                      "that wrote it, or compute it anew",
                      number, format));
  }
  const auto sum = solution.text.extract(sum_name);
  return sum ? sum.mapped() : "";
}

// Whether a zone has coordinates of its own for each step.
bool has_grid_pointers(const CgnsFile& file, int number, const std::string& where) {
  if (cg_goto(file.number(), 1, "Zone_t", number, "ZoneIterativeData_t", 1, "end") != CG_OK) return false;
  int count = 0;
  file.check(cg_narrays(&count), where);
  for (int a = 1; a <= count; ++a) {
    Name name{};
    CGNS_ENUMT(DataType_t) type{};
    int dimension = 0;
    std::array<cgsize_t, 12> size{};
    file.check(cg_array_info(a, name.data(), &type, &dimension, size.data()), where);
    if (std::string_view(name.data()) == "GridCoordinatesPointers") return true;
  }
  return false;
}

}  // namespace

template <int Dim>
Solution<Dim> read_solution(const std::filesystem::path& path, const MultiblockMesh<Dim>& mesh) {
  const CgnsFile file = CgnsFile::open(path);
  Name name{};
  int cell_dim = 0;
  int physical_dim = 0;
  file.check(cg_base_read(file.number(), 1, name.data(), &cell_dim, &physical_dim), "base");
  if (cell_dim != Dim)
    file.refuse(fmt::format("its CellDim is {}, the mesh has {} dimensions", cell_dim, Dim));
  int zone_count = 0;
  file.check(cg_nzones(file.number(), 1, &zone_count), "zones");
  if (static_cast<std::size_t>(zone_count) != mesh.zones.size())
    file.refuse(fmt::format("has {} zones, the mesh has {}: it is the solution of another mesh", zone_count,
                            mesh.zones.size()));

  Solution<Dim> solution;
  for (double time : read_times(file)) solution.instances.push_back({time, {}});
  const std::string sum = read_restart_data(file, solution);
  for (const Zone<Dim>& zone : mesh.zones) {
    const int number = find_zone(file, zone);
    const bool moving = has_grid_pointers(file, number, zone.name);
    for (std::size_t n = 0; n < solution.instances.size(); ++n) {
      ZoneSolution<Dim> now;
      now.fields = read_flow(file, number, zone, flow_name(n));
      if (moving) now.nodes = read_grid(file, number, zone, grid_name(n));
      solution.instances[n].zones.push_back(std::move(now));
    }
  }
  if (!sum.empty() && sum != sum_of(solution))
    file.refuse(fmt::format("is damaged: its numbers are not those that were written; take {}",
                            previous_solution(path.filename()).string()));
  return solution;
}

template Solution<2> read_solution<2>(const std::filesystem::path&, const MultiblockMesh<2>&);
template Solution<3> read_solution<3>(const std::filesystem::path&, const MultiblockMesh<3>&);

}  // namespace wingbeat
