#include <cgnslib.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "core/io/error.hpp"
#include "core/io/file.hpp"
#include "core/mesh/cgns_file.hpp"
#include "core/mesh/cgns_mesh.hpp"
#include "core/mesh/solution_file.hpp"
#include "core/mesh/solution_layout.hpp"

namespace wingbeat {
namespace {

using namespace solution_layout;

template <int Dim>
bool has_moving_nodes(const Solution<Dim>& solution) {
  return !solution.instances.empty() && !solution.instances.front().zones.empty() &&
         !solution.instances.front().zones.front().nodes.empty();
}

template <int Dim>
void check_shape(const MultiblockMesh<Dim>& mesh, const Solution<Dim>& solution) {
  ensure(!solution.instances.empty(), "a solution has at least one instance");
  const bool moving = has_moving_nodes(solution);
  for (std::size_t n = 0; n < solution.instances.size(); ++n) {
    const SolutionInstance<Dim>& instance = solution.instances[n];
    ensure(n == 0 || instance.time > solution.instances[n - 1].time, "times of instances increase");
    ensure(instance.zones.size() == mesh.zones.size(), "an instance has every zone");
    for (std::size_t z = 0; z < mesh.zones.size(); ++z) {
      for (const SolutionField& field : instance.zones[z].fields)
        ensure(field.values.size() == box_of<Dim>(mesh.zones[z].cells).size(),
               "a field has a value for each cell");
      ensure(instance.zones[z].nodes.size() == (moving ? mesh.zones[z].nodes.interior().size() : 0),
             "all zones of all instances have all their nodes, or none has any");
    }
  }
  const auto is_name = [](const std::string& name) {
    return !name.empty() && name.size() <= name_length && name != format_name && name != sum_name;
  };
  for (const auto& [name, values] : solution.data)
    ensure(!values.empty() && is_name(name), "restart data has a name and values");
  for (const auto& [name, text] : solution.text)
    ensure(!text.empty() && is_name(name) && !solution.data.contains(name), "restart text has a name");
}

template <int Dim>
std::array<cgsize_t, Dim> sizes(const Index<Dim>& extents) {
  std::array<cgsize_t, Dim> result{};
  std::copy(extents.begin(), extents.end(), result.begin());
  return result;
}

// Goes to a node below a zone.
template <class... Path>
void go_to(const CgnsFile& file, int base, int zone, const std::string& where, Path... path) {
  file.check(cg_goto(file.number(), base, "Zone_t", zone, path..., "end"), where);
}

// A table of names, one of 32 characters a step, in the current node.
void write_pointers(const CgnsFile& file, const char* array, std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names) text += fmt::format("{:<32}", name);
  const std::array<cgsize_t, 2> size{static_cast<cgsize_t>(name_length), static_cast<cgsize_t>(names.size())};
  file.check(cg_array_write(array, CGNS_ENUMV(Character), 2, size.data(), text.data()), array);
}

void write_times(const CgnsFile& file, int base, std::span<const double> times) {
  const auto count = static_cast<cgsize_t>(times.size());
  file.check(cg_simulation_type_write(file.number(), base, CGNS_ENUMV(TimeAccurate)), "simulation type");
  file.check(cg_biter_write(file.number(), base, "BaseIterativeData", static_cast<int>(count)), "times");
  file.check(cg_goto(file.number(), base, "BaseIterativeData_t", 1, "end"), "times");
  file.check(cg_array_write("TimeValues", CGNS_ENUMV(RealDouble), 1, &count, times.data()), "times");
}

void write_text(const CgnsFile& file, const std::string& name, const std::string& text) {
  const auto length = static_cast<cgsize_t>(text.size());
  file.check(cg_array_write(name.c_str(), CGNS_ENUMV(Character), 1, &length, text.data()), name);
}

void write_values(const CgnsFile& file, const std::string& name, std::span<const double> values) {
  const auto count = static_cast<cgsize_t>(values.size());
  file.check(cg_array_write(name.c_str(), CGNS_ENUMV(RealDouble), 1, &count, values.data()), name);
}

template <int Dim>
void write_restart_data(const CgnsFile& file, int base, const Solution<Dim>& solution) {
  file.check(cg_goto(file.number(), base, "end"), restart_node);
  file.check(cg_user_data_write(restart_node), restart_node);
  file.check(cg_goto(file.number(), base, restart_node, 0, "end"), restart_node);
  write_values(file, format_name, {&format, 1});
  write_text(file, sum_name, sum_of(solution));
  for (const auto& [name, values] : solution.data) write_values(file, name, values);
  for (const auto& [name, text] : solution.text) write_text(file, name, text);
}

template <int Dim>
void write_grid(const CgnsFile& file, int base, int number, const Zone<Dim>& zone, const std::string& name,
                std::span<const Vec<double, Dim>> nodes) {
  const std::string where = fmt::format("zone '{}', {}", zone.name, name);
  int grid = 0;
  file.check(cg_grid_write(file.number(), base, number, name.c_str(), &grid), where);
  go_to(file, base, number, where, "GridCoordinates_t", grid);
  const auto size = sizes<Dim>(zone.nodes.extents());
  std::vector<double> component(nodes.size());
  for (int c = 0; c < Dim; ++c) {
    std::transform(nodes.begin(), nodes.end(), component.begin(), [&](const auto& node) { return node[c]; });
    file.check(cg_array_write(coordinate_name(c).c_str(), CGNS_ENUMV(RealDouble), Dim, size.data(),
                              component.data()),
               where);
  }
}

template <int Dim>
void write_flow(const CgnsFile& file, int base, int number, const Zone<Dim>& zone, const std::string& name,
                const std::vector<SolutionField>& fields) {
  const std::string where = fmt::format("zone '{}', {}", zone.name, name);
  int flow = 0;
  file.check(cg_sol_write(file.number(), base, number, name.c_str(), CGNS_ENUMV(CellCenter), &flow), where);
  for (const SolutionField& field : fields) {
    int written = 0;
    file.check(cg_field_write(file.number(), base, number, flow, CGNS_ENUMV(RealDouble), field.name.c_str(),
                              field.values.data(), &written),
               where + ", " + field.name);
  }
}

template <int Dim>
void write_zone_solution(const CgnsFile& file, int base, std::size_t z, const Zone<Dim>& zone,
                         const Solution<Dim>& solution) {
  const int number = static_cast<int>(z) + 1;
  const bool moving = has_moving_nodes(solution);
  std::vector<std::string> flows;
  std::vector<std::string> grids;
  for (std::size_t n = 0; n < solution.instances.size(); ++n) {
    const ZoneSolution<Dim>& now = solution.instances[n].zones[z];
    flows.push_back(flow_name(n));
    write_flow(file, base, number, zone, flows.back(), now.fields);
    if (!moving) continue;
    grids.push_back(grid_name(n));
    write_grid<Dim>(file, base, number, zone, grids.back(), now.nodes);
  }
  const std::string where = fmt::format("zone '{}', ZoneIterativeData", zone.name);
  file.check(cg_ziter_write(file.number(), base, number, "ZoneIterativeData"), where);
  go_to(file, base, number, where, "ZoneIterativeData_t", 1);
  write_pointers(file, "FlowSolutionPointers", flows);
  if (moving) write_pointers(file, "GridCoordinatesPointers", grids);
}

}  // namespace

template <int Dim>
void write_solution(const std::filesystem::path& path, const MultiblockMesh<Dim>& mesh,
                    const Solution<Dim>& solution) {
  check_shape(mesh, solution);
  AtomicFile target(path);
  CgnsFile file = CgnsFile::create(target.temporary(), path);
  const int base = write_cgns_base(file, mesh);
  std::vector<double> times;
  for (const SolutionInstance<Dim>& instance : solution.instances) times.push_back(instance.time);
  write_times(file, base, times);
  write_restart_data(file, base, solution);
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    write_zone_solution(file, base, z, mesh.zones[z], solution);
  file.close();
  target.commit_keeping(previous_solution(path));
}

std::filesystem::path previous_solution(const std::filesystem::path& path) {
  auto previous = path;
  return previous.replace_extension(".previous" + path.extension().string());
}

template void write_solution<2>(const std::filesystem::path&, const MultiblockMesh<2>&, const Solution<2>&);
template void write_solution<3>(const std::filesystem::path&, const MultiblockMesh<3>&, const Solution<3>&);

}  // namespace wingbeat
