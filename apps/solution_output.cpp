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
#include "flow/flow_fault.hpp"
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

// All cells of the levels or instances w of the mesh, on rank 0. Collective.
Solution<2> gathered_solution(const Context& context, const FlowLevel<2>& level, const std::vector<double>& w,
                              std::span<const double> y, const std::vector<double>& times) {
  const int instances = static_cast<int>(y.size() / 4);
  const std::vector<double> whole = gather_to_root(context.comm, level.local.global_cell, w, instances, n);
  Solution<2> solution;
  if (!context.comm.is_root()) return solution;
  for (int i = 0; i < instances; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto position = position_of(context.settings, y.subspan(4 * at, 4));
    const bool moves = position.pitch != 0.0 || position.plunge != 0.0;
    auto instance =
        instance_of(level.mesh, whole.data() + at * level.mesh.cell_count() * n, context.settings.flow.gamma,
                    level.domain.axis(), position, moves || instances > 1);
    instance.time = times[at];
    solution.instances.push_back(std::move(instance));
  }
  solution.data["y"] = {y.begin(), y.end()};
  solution.data["mach"] = {context.settings.flow.mach};
  return solution;
}

// The instances of a period, or of steady flow, and what a restart needs besides. Collective.
Solution<2> periodic_solution(const Context& context, const FlowLevel<2>& level,
                              const AeroelasticState& state) {
  const std::size_t instances = state.y.size() / 4;
  const TimeSpectral time(static_cast<int>(instances - 1) / 2);
  std::vector<double> times(instances, 0.0);
  if (state.omega > 0.0)
    for (std::size_t i = 0; i < instances; ++i) times[i] = time.phase(static_cast<int>(i)) / state.omega;
  Solution<2> solution = gathered_solution(context, level, state.w, state.y, times);
  solution.data["omega"] = {state.omega};
  solution.data["freestream_parameter"] = {state.r};
  solution.data["reduced_velocity"] = {section_kinematics(context.settings).reduced_velocity(state.r)};
  return solution;
}

}  // namespace

SurfaceTable::SurfaceTable()
    : table_({"instance", "phase", "block", "x", "y", "x_body", "y_body", "cp", "mach"}) {}

void SurfaceTable::add(const Context& context, const FlowLevel<2>& level, double phase,
                       std::span<const double> w, std::span<const double> y) {
  for (const SurfacePoint& p :
       surface_points<2>(level, level.steady.model(), w, position_of(context.settings, y)))
    table_.add({instances_, phase, level.mesh.zones[static_cast<std::size_t>(p.zone)].name, p.place[0],
                p.place[1], p.body[0], p.body[1], p.cp, p.mach});
  ++instances_;
}

void SurfaceTable::write(const Context& context) const {
  on_root(context.comm, [&] { table_.write(context.output / "surface.csv"); });
}

void write_further_solution(const Context& context, const FlowLevel<2>& level, const AeroelasticState& state,
                            const std::string& name) {
  const Solution<2> solution = periodic_solution(context, level, state);
  on_root(context.comm, [&] { write_solution<2>(context.output / name, level.mesh, solution); });
}

void write_solution_files(const Context& context, const FlowLevel<2>& level, const AeroelasticState& state) {
  write_further_solution(context, level, state, "solution.cgns");
  on_root(context.comm, [&] { near_wall_nodes(level.mesh).write(context.output / "mesh.csv"); });
  const std::size_t instances = state.y.size() / 4, count = level.domain.state_count();
  const TimeSpectral time(static_cast<int>(instances - 1) / 2);
  SurfaceTable surface;
  for (std::size_t i = 0; i < instances; ++i)
    surface.add(context, level, time.phase(static_cast<int>(i)),
                std::span<const double>(state.w).subspan(i * count, count),
                std::span<const double>(state.y).subspan(4 * i, 4));
  surface.write(context);
}

void write_time_levels(const Context& context, const FlowLevel<2>& level, const TimeLevels& levels) {
  std::vector<double> w, y, times;
  for (std::size_t k = 0; k < std::min(levels.w.size(), levels.y.size()); ++k) {
    w.insert(w.end(), levels.w[k].begin(), levels.w[k].end());
    y.insert(y.end(), levels.y[k].begin(), levels.y[k].end());
    times.push_back(static_cast<double>(k) * levels.dtau);
  }
  Solution<2> solution = gathered_solution(context, level, w, y, times);
  const double v = levels.reduced_velocity;
  solution.data["omega"] = {0.0};
  solution.data["freestream_parameter"] = {
      std::pow(v / section_kinematics(context.settings).reference_velocity, 2)};
  solution.data["reduced_velocity"] = {v};
  solution.data["time_step"] = {levels.dtau};
  solution.data["rest"] = levels.rest_y;
  on_root(context.comm, [&] {
    write_solution<2>(context.output / "solution.cgns", level.mesh, solution);
    near_wall_nodes(level.mesh).write(context.output / "mesh.csv");
  });
}

StoredSolution read_stored_solution(const Context& context, const FlowLevel<2>& level,
                                    const std::filesystem::path& file) {
  std::vector<double> whole, data;
  double count = 0.0;
  on_root(context.comm, [&] {
    const Solution<2> solution = read_solution<2>(file, level.mesh);
    const int held = static_cast<int>(solution.instances.size());
    count = held;
    for (const auto& instance : solution.instances)
      for (const auto& zone : instance.zones)
        for (std::size_t c = 0; c < zone.fields[0].values.size(); ++c)
          for (const char* name : state_names) {
            const auto field = std::find_if(zone.fields.begin(), zone.fields.end(),
                                            [&](const SolutionField& f) { return f.name == name; });
            if (field == zone.fields.end())
              throw InputError(fmt::format("{}: no field {}", file.string(), name));
            whole.push_back(field->values[c]);
          }
    const std::string fault = describe_fault<2>(level.mesh, whole, context.settings.flow.gamma);
    if (!fault.empty())
      throw InputError(fmt::format(
          "{}: holds no flow: {}; the file is damaged: start from another one, or without --restart",
          context.restart->string(), fault));
    const auto value = [&](const char* name) {
      const auto found = solution.data.find(name);
      if (found == solution.data.end())
        throw InputError(
            fmt::format("{}: no restart data \"{}\"; it was not written by wingbeat", file.string(), name));
      return found->second;
    };
    data = value("y");
    data.push_back(value("omega")[0]);
    data.push_back(value("freestream_parameter")[0]);
    const bool is_march = solution.data.contains("time_step");
    data.push_back(value("mach")[0]);
    data.push_back(is_march ? value("time_step")[0] : 0.0);
    const std::vector<double> rest = is_march ? value("rest") : std::vector<double>(4, 0.0);
    data.insert(data.begin(), rest.begin(), rest.end());
    if (data.size() != static_cast<std::size_t>(4 * held + 8))
      throw InputError(fmt::format("{}: its structural state does not fit", file.string()));
  });
  context.comm.broadcast(count);
  const int instances = static_cast<int>(count);
  data.resize(static_cast<std::size_t>(4 * instances + 8));
  context.comm.broadcast(data);
  StoredSolution stored;
  stored.state.w = scatter_from_root(context.comm, level.local.global_cell, whole, instances, n);
  if (data.back() > 0.0) stored.time_step = data.back();
  stored.rest_y.assign(data.begin(), data.begin() + 4);
  stored.mach = data[data.size() - 2];
  stored.state.r = data[data.size() - 3];
  stored.state.omega = data[data.size() - 4];
  stored.state.y.assign(data.begin() + 4, data.end() - 4);
  return stored;
}

AeroelasticState read_restart(const Context& context, const FlowLevel<2>& level,
                              const std::vector<int>& allowed_instances) {
  StoredSolution stored = read_stored_solution(context, level, *context.restart);
  if (stored.time_step)
    throw InputError(fmt::format("{}: holds time levels of a march; only wingbeat march goes on from these",
                                 context.restart->string()));
  if (std::ranges::find(allowed_instances, stored.instances()) == allowed_instances.end())
    throw InputError(
        fmt::format("{}: holds {} instances, this run can start from {}; set time.harmonics to match",
                    context.restart->string(), stored.instances(), fmt::join(allowed_instances, " or ")));
  return std::move(stored.state);
}

}  // namespace wingbeat
