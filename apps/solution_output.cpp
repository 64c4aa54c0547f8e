#include "apps/solution_output.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "apps/flow_setup.hpp"
#include "apps/mesh_table.hpp"
#include "apps/on_root.hpp"
#include "core/io/csv.hpp"
#include "core/io/error.hpp"
#include "core/mesh/solution_file.hpp"
#include "partition/gather_field.hpp"

namespace wingbeat {
namespace {

constexpr int n = state_size<2>;
constexpr std::array<const char*, n> state_names{"Density", "MomentumX", "MomentumY",
                                                 "EnergyStagnationDensity"};

SectionPosition position_of(const CaseSettings& settings, std::span<const double> y) {
  const double mean = section_kinematics(settings).mean_pitch;
  return {mean + y[1], SectionKinematics::semichord * y[0]};
}

// Fields of one zone from its cells, [cell][variable].
std::vector<SolutionField> zone_fields(const double* w, std::size_t cells, double gamma) {
  std::vector<SolutionField> fields;
  for (const char* name : state_names) fields.push_back({name, {}});
  fields.push_back({"Pressure", {}});
  fields.push_back({"Mach", {}});
  for (std::size_t c = 0; c < cells; ++c) {
    State<2, double> state;
    for (int v = 0; v < n; ++v) {
      state[v] = w[c * n + static_cast<std::size_t>(v)];
      fields[static_cast<std::size_t>(v)].values.push_back(state[v]);
    }
    const double p = pressure<2, double>(state, gamma);
    const auto u = velocity<2, double>(state);
    fields[n].values.push_back(p);
    fields[n + 1].values.push_back(std::sqrt(dot(u, u) * state[0] / (gamma * p)));
  }
  return fields;
}

SolutionInstance<2> instance_of(const MultiblockMesh<2>& mesh, const double* w, double gamma,
                                const Vec<double, 2>& axis, const SectionPosition& position, bool moves) {
  SolutionInstance<2> instance;
  for (const Zone<2>& zone : mesh.zones) {
    ZoneSolution<2> part;
    const std::size_t cells = box_of<2>(zone.cells).size();
    part.fields = zone_fields(w, cells, gamma);
    w += cells * n;
    if (moves)
      for_each(zone.nodes.interior(), [&](const Index<2>& node) {
        part.nodes.push_back(carried<2>(zone.nodes(node), axis, position));
      });
    instance.zones.push_back(std::move(part));
  }
  return instance;
}

void write_surface(const Context& context, const FlowLevel<2>& level, const AeroelasticState& state) {
  const TimeSpectral time(static_cast<int>(state.y.size() / 4 - 1) / 2);
  CsvTable table({"instance", "phase", "block", "x", "y", "x_body", "y_body", "cp", "mach"});
  const std::size_t count = level.domain.state_count();
  for (int i = 0; i < time.instances(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto position = position_of(context.settings, std::span<const double>(state.y).subspan(4 * at, 4));
    const auto points = surface_points<2>(
        level, level.steady.model(), std::span<const double>(state.w).subspan(at * count, count), position);
    for (const SurfacePoint& p : points)
      table.add({static_cast<long>(i), time.phase(i), level.mesh.zones[static_cast<std::size_t>(p.zone)].name,
                 p.place[0], p.place[1], p.body[0], p.body[1], p.cp, p.mach});
  }
  on_root(context.comm, [&] { table.write(context.output / "surface.csv"); });
}

}  // namespace

void write_solution_files(const Context& context, const FlowLevel<2>& level, const AeroelasticState& state) {
  const int instances = static_cast<int>(state.y.size() / 4);
  const TimeSpectral time((instances - 1) / 2);
  const std::vector<double> whole =
      gather_to_root(context.comm, level.local.global_cell, state.w, instances, n);
  const SectionKinematics kinematics = section_kinematics(context.settings);
  on_root(context.comm, [&] {
    Solution<2> solution;
    for (int i = 0; i < instances; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto position =
          position_of(context.settings, std::span<const double>(state.y).subspan(4 * at, 4));
      const bool moves = position.pitch != 0.0 || position.plunge != 0.0;
      auto instance =
          instance_of(level.mesh, whole.data() + at * level.mesh.cell_count() * n,
                      context.settings.flow.gamma, level.domain.axis(), position, moves || instances > 1);
      if (state.omega > 0.0) instance.time = time.phase(i) / state.omega;
      solution.instances.push_back(std::move(instance));
    }
    solution.data["y"] = state.y;
    solution.data["omega"] = {state.omega};
    solution.data["freestream_parameter"] = {state.r};
    solution.data["reduced_velocity"] = {kinematics.reduced_velocity(state.r)};
    solution.data["mach"] = {context.settings.flow.mach};
    write_solution<2>(context.output / "solution.cgns", level.mesh, solution);
    near_wall_nodes(level.mesh).write(context.output / "mesh.csv");
  });
  write_surface(context, level, state);
}

AeroelasticState read_restart(const Context& context, const FlowLevel<2>& level,
                              const std::vector<int>& allowed_instances) {
  std::vector<double> whole, data;
  double count = 0.0;
  on_root(context.comm, [&] {
    const Solution<2> solution = read_solution<2>(*context.restart, level.mesh);
    const int held = static_cast<int>(solution.instances.size());
    if (std::ranges::find(allowed_instances, held) == allowed_instances.end())
      throw InputError(
          fmt::format("{}: holds {} instances, this run can start from {}; set time.harmonics to match",
                      context.restart->string(), held, fmt::join(allowed_instances, " or ")));
    count = held;
    for (const auto& instance : solution.instances)
      for (const auto& zone : instance.zones)
        for (std::size_t c = 0; c < zone.fields[0].values.size(); ++c)
          for (const char* name : state_names) {
            const auto field = std::find_if(zone.fields.begin(), zone.fields.end(),
                                            [&](const SolutionField& f) { return f.name == name; });
            if (field == zone.fields.end())
              throw InputError(fmt::format("{}: no field {}", context.restart->string(), name));
            whole.push_back(field->values[c]);
          }
    const auto value = [&](const char* name) {
      const auto found = solution.data.find(name);
      if (found == solution.data.end())
        throw InputError(fmt::format("{}: no restart data \"{}\"; it was not written by wingbeat",
                                     context.restart->string(), name));
      return found->second;
    };
    data = value("y");
    data.push_back(value("omega")[0]);
    data.push_back(value("freestream_parameter")[0]);
    if (data.size() != static_cast<std::size_t>(4 * held + 2))
      throw InputError(fmt::format("{}: its structural state does not fit", context.restart->string()));
  });
  context.comm.broadcast(count);
  const int instances = static_cast<int>(count);
  data.resize(static_cast<std::size_t>(4 * instances + 2));
  context.comm.broadcast(data);
  AeroelasticState state;
  state.w = scatter_from_root(context.comm, level.local.global_cell, whole, instances, n);
  state.r = data.back();
  state.omega = data[data.size() - 2];
  state.y.assign(data.begin(), data.end() - 2);
  return state;
}

}  // namespace wingbeat
