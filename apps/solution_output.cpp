#include "apps/solution_output.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/fingerprint.hpp"
#include "apps/flow_setup.hpp"
#include "apps/mesh_table.hpp"
#include "apps/on_root.hpp"
#include "apps/solution_names.hpp"
#include "apps/version.hpp"
#include "core/io/csv.hpp"
#include "core/mesh/solution_file.hpp"
#include "partition/gather_field.hpp"

namespace wingbeat {
namespace {

using namespace solution_names;

constexpr int state_values = state_size<2>;

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
    for (int v = 0; v < state_values; ++v) {
      state[v] = w[c * state_values + static_cast<std::size_t>(v)];
      fields[static_cast<std::size_t>(v)].values.push_back(state[v]);
    }
    const double p = pressure<2, double>(state, gamma);
    const auto u = velocity<2, double>(state);
    fields[state_values].values.push_back(p);
    fields[state_values + 1].values.push_back(std::sqrt(dot(u, u) * state[0] / (gamma * p)));
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
    w += cells * state_values;
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
  const std::vector<double> whole =
      gather_to_root(context.comm, level.local.global_cell, w, instances, state_values);
  Solution<2> solution;
  if (!context.comm.is_root()) return solution;
  for (int i = 0; i < instances; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto position = position_of(context.settings, y.subspan(4 * at, 4));
    const bool moves = position.pitch != 0.0 || position.plunge != 0.0;
    auto instance =
        instance_of(level.mesh, whole.data() + at * level.mesh.cell_count() * state_values,
                    context.settings.flow.gamma, level.domain.axis(), position, moves || instances > 1);
    instance.time = times[at];
    solution.instances.push_back(std::move(instance));
  }
  solution.data[y_name] = {y.begin(), y.end()};
  solution.data[mach_name] = {context.settings.flow.mach};
  solution.text = {{case_name, fingerprint(context.settings, context.sources)},
                   {version_name, context.result.version},
                   {commit_name, std::string(git_commit())},
                   {verb_name, context.result.command}};
  return solution;
}

// Adds what the solver goes on with. Collective.
void add_memory(const Context& context, const FlowLevel<2>& level, const SolverMemory& memory,
                Solution<2>& solution) {
  const std::size_t slice = level.domain.state_count();
  for (int i = 1; const std::vector<double>& field : memory.fields) {
    const double instances =
        context.comm.max(slice > 0 ? static_cast<double>(field.size()) / static_cast<double>(slice) : 0.0);
    std::vector<double> whole = gather_to_root(context.comm, level.local.global_cell, field,
                                               static_cast<int>(std::lround(instances)), state_values);
    if (context.comm.is_root()) solution.data[memory_field_name(i)] = std::move(whole);
    ++i;
  }
  solution.text[stage_name] = memory.stage;
  solution.data[memory_name] = memory.numbers;
}

void write(const Context& context, const FlowLevel<2>& level, const Solution<2>& solution,
           const std::string& name = "solution.cgns") {
  on_root(context.comm, [&] { write_solution<2>(context.output / name, level.mesh, solution); });
}

// Times of the instances of a period; steady flow is one instance at time 0.
std::vector<double> instance_times(const AeroelasticState& state) {
  const std::size_t instances = state.y.size() / 4;
  std::vector<double> times(instances, 0.0);
  if (state.omega <= 0.0) return times;
  const TimeSpectral time(static_cast<int>(instances - 1) / 2);
  for (std::size_t i = 0; i < instances; ++i) times[i] = time.phase(static_cast<int>(i)) / state.omega;
  return times;
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

void write_checkpoint(const Context& context, const FlowLevel<2>& level, const AeroelasticState& state,
                      const std::optional<SolverMemory>& memory, const std::string& name) {
  const auto part = context.timer.measure("checkpoint");
  Solution<2> solution = gathered_solution(context, level, state.w, state.y, instance_times(state));
  solution.data[omega_name] = {state.omega};
  solution.data[freestream_parameter_name] = {state.r};
  solution.data[reduced_velocity_name] = {section_kinematics(context.settings).reduced_velocity(state.r)};
  if (memory) add_memory(context, level, *memory, solution);
  write(context, level, solution, name);
}

void write_solution_files(const Context& context, const FlowLevel<2>& level, const AeroelasticState& state,
                          const std::optional<SolverMemory>& memory) {
  write_checkpoint(context, level, state, memory);
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
  const auto part = context.timer.measure("checkpoint");
  Solution<2> solution = gathered_solution(context, level, w, y, times);
  const double v = levels.reduced_velocity;
  solution.data[omega_name] = {0.0};
  solution.data[freestream_parameter_name] = {
      std::pow(v / section_kinematics(context.settings).reference_velocity, 2)};
  solution.data[reduced_velocity_name] = {v};
  solution.data[time_step_name] = {levels.dtau};
  solution.data[rest_name] = levels.rest_y;
  const MarchProgress& progress = levels.progress;
  const auto add = [&](const char* name, const std::vector<double>& values) {
    if (!values.empty()) solution.data[name] = values;
  };
  add(record_name, progress.record);
  add(rows_name, progress.rows);
  add(search_name, progress.search);
  if (!progress.entries.empty()) solution.text[entries_name] = progress.entries;
  if (progress.memory) add_memory(context, level, *progress.memory, solution);
  write(context, level, solution);
  on_root(context.comm, [&] { near_wall_nodes(level.mesh).write(context.output / "mesh.csv"); });
}

}  // namespace wingbeat
