#include "apps/restart.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "apps/fingerprint.hpp"
#include "apps/on_root.hpp"
#include "apps/solution_names.hpp"
#include "core/io/error.hpp"
#include "core/mesh/cgns_mesh.hpp"
#include "core/mesh/matching_cells.hpp"
#include "core/mesh/solution_file.hpp"
#include "flow/flow_fault.hpp"
#include "partition/gather_field.hpp"

namespace wingbeat {
namespace {

namespace fs = std::filesystem;
using namespace solution_names;

constexpr int n = state_size<2>;
constexpr std::size_t states = 4;  // of the structure, an instance

// A solution as its file has it, cells in the order of the file's mesh.
struct StoredFile {
  MultiblockMesh<2> mesh;
  Solution<2> solution;
};

StoredFile read_file_of(const fs::path& path) {
  AnyMesh mesh = read_cgns(path);
  if (!std::holds_alternative<MultiblockMesh<2>>(mesh))
    throw InputError(fmt::format("{}: is the solution of a three-dimensional mesh", path.string()));
  StoredFile stored{std::get<MultiblockMesh<2>>(std::move(mesh)), {}};
  stored.solution = read_solution<2>(path, stored.mesh);
  return stored;
}

bool has_same_zones(const MultiblockMesh<2>& a, const MultiblockMesh<2>& b) {
  return std::ranges::equal(a.zones, b.zones, {}, &Zone<2>::cells, &Zone<2>::cells);
}

std::string of_another_mesh(const Context& context, const fs::path& path, const Solution<2>& solution) {
  std::vector<KeyChange> changes;
  if (const auto found = solution.text.find(case_name); found != solution.text.end())
    changes = key_changes(found->second, context.settings, context.sources);
  std::erase_if(changes, [](const KeyChange& change) {
    return (change.section() != "mesh" && change.section() != "design") || change.key == "mesh.blocks";
  });
  return fmt::format(
      "{}: is the solution of another mesh or section{}; give the case those it was computed on, "
      "or start without --restart",
      path.string(), changes.empty() ? "" : ": " + listed(changes));
}

// For every cell of the run's mesh the one of the file.
std::vector<long> cells_of(const Context& context, const MultiblockMesh<2>& mesh, const fs::path& path,
                           const StoredFile& stored) {
  if (auto cells = matching_cells<2>(stored.mesh, mesh)) return *std::move(cells);
  if (context.is_restart_judged || !has_same_zones(stored.mesh, mesh))
    throw InputError(of_another_mesh(context, path, stored.solution));
  std::vector<long> same(mesh.cell_count());
  std::iota(same.begin(), same.end(), 0L);
  return same;
}

// The conservative variables of one field at all instances: [instance][cell][variable], cells in the file's
// order.
std::vector<double> whole_state(const fs::path& path, const Solution<2>& solution) {
  std::vector<double> whole;
  for (const auto& instance : solution.instances)
    for (const auto& zone : instance.zones) {
      std::array<const SolutionField*, n> fields{};
      for (std::size_t v = 0; v < n; ++v) {
        const auto field = std::ranges::find(zone.fields, state_names[v], &SolutionField::name);
        if (field == zone.fields.end())
          throw InputError(fmt::format("{}: no field {}", path.string(), state_names[v]));
        fields[v] = &*field;
      }
      for (std::size_t c = 0; c < fields[0]->values.size(); ++c)
        for (const SolutionField* field : fields) whole.push_back(field->values[c]);
    }
  return whole;
}

// The same with the run's cells. A field may have any number of instances.
std::vector<double> reordered(const std::vector<double>& whole, const std::vector<long>& cells) {
  std::vector<double> result(whole.size());
  const std::size_t slice = cells.size() * n;
  for (std::size_t begin = 0; begin + slice <= whole.size(); begin += slice)
    for (std::size_t c = 0; c < cells.size(); ++c)
      std::copy_n(whole.data() + begin + static_cast<std::size_t>(cells[c]) * n, n,
                  result.data() + begin + c * n);
  return result;
}

// Numbers that every rank needs, to every rank.
void broadcast(const Comm& comm, std::map<std::string, std::vector<double>>& data) {
  std::string names;
  std::vector<double> sizes, values;
  for (const auto& [name, list] : data) {
    names += name + '\n';
    sizes.push_back(static_cast<double>(list.size()));
    values.insert(values.end(), list.begin(), list.end());
  }
  names = comm.broadcast(names);
  sizes.resize(static_cast<std::size_t>(std::ranges::count(names, '\n')));
  comm.broadcast(sizes);
  values.resize(static_cast<std::size_t>(std::accumulate(sizes.begin(), sizes.end(), 0.0)));
  comm.broadcast(values);
  data.clear();
  auto value = values.begin();
  for (std::size_t i = 0, begin = 0; i < sizes.size(); ++i) {
    const std::size_t end = names.find('\n', begin);
    const auto next = value + static_cast<std::ptrdiff_t>(sizes[i]);
    data[names.substr(begin, end - begin)].assign(value, next);
    value = next;
    begin = end + 1;
  }
}

void broadcast(const Comm& comm, std::map<std::string, std::string>& text) {
  std::string names;
  for (const auto& entry : text) names += entry.first + '\n';
  names = comm.broadcast(names);
  for (std::size_t begin = 0; begin < names.size();) {
    const std::size_t end = names.find('\n', begin);
    std::string& value = text[names.substr(begin, end - begin)];
    value = comm.broadcast(value);
    begin = end + 1;
  }
}

// Tells what is not as it was, and whether it is the same problem; what the solver knew is kept only where it
// can go on with it.
void judge(const Context& context, StoredSolution& stored) {
  const std::string verb = context.result.command;
  const auto found = stored.text.find(case_name);
  if (found == stored.text.end()) {
    if (context.is_restart_judged)
      context.log.line("{}: says nothing of the case it is of: taken as a start", context.restart->string());
    stored.memory.reset();
    return;
  }
  std::vector<KeyChange> changes = key_changes(found->second, context.settings, context.sources);
  if (!std::ranges::all_of(changes, keeps_iteration)) stored.memory.reset();
  std::erase_if(changes, [&](const KeyChange& change) { return !is_of_the_problem(change, verb); });
  stored.is_same_problem = changes.empty();
  if (!context.is_restart_judged) return;
  if (!changes.empty())
    context.log.line("{}: is of another case, and so a start: {}", context.restart->string(),
                     listed(changes));
  if (const auto version = stored.text.find(version_name);
      version != stored.text.end() && version->second != context.result.version)
    context.log.line("{}: was written by version {}, this is {}", context.restart->string(), version->second,
                     context.result.version);
}

}  // namespace

std::optional<double> StoredSolution::time_step() const {
  const auto found = data.find(time_step_name);
  return found == data.end() ? std::nullopt : std::optional(found->second.at(0));
}

std::vector<double> StoredSolution::rest_y() const {
  const auto found = data.find(rest_name);
  return found == data.end() ? std::vector<double>(states, 0.0) : found->second;
}

StoredSolution read_stored_solution(const Context& context, const FlowLevel<2>& level, const fs::path& path) {
  StoredSolution stored;
  std::vector<std::vector<double>> fields;  // the state, then those of the solver's memory
  double count = 0.0, is_own = 0.0;
  on_root(context.comm, [&] {
    StoredFile file = read_file_of(path);
    const std::vector<long> cells = cells_of(context, level.mesh, path, file);
    fields.push_back(reordered(whole_state(path, file.solution), cells));
    const std::string fault = describe_fault<2>(level.mesh, fields[0], context.settings.flow.gamma);
    if (!fault.empty())
      throw InputError(fmt::format(
          "{}: holds no flow: {}; the file is damaged: start from another one, or without --restart",
          path.string(), fault));
    for (int i = 1;; ++i) {
      const auto field = file.solution.data.extract(memory_field_name(i));
      if (!field) break;
      fields.push_back(reordered(field.mapped(), cells));
    }
    stored.data = std::move(file.solution.data);
    stored.text = std::move(file.solution.text);
    count = static_cast<double>(fields.size());
    std::error_code ignored;
    is_own = fs::equivalent(fs::absolute(path).parent_path(), context.output, ignored) ? 1.0 : 0.0;
    for (const char* name : {y_name, omega_name, freestream_parameter_name})
      if (!stored.data.contains(name))
        throw InputError(
            fmt::format("{}: no restart data \"{}\"; it was not written by wingbeat", path.string(), name));
    if (stored.data[y_name].size() != states * file.solution.instances.size())
      throw InputError(fmt::format("{}: its structural state does not fit", path.string()));
  });
  broadcast(context.comm, stored.data);
  broadcast(context.comm, stored.text);
  context.comm.broadcast(count);
  context.comm.broadcast(is_own);
  fields.resize(static_cast<std::size_t>(count));

  const double slice = static_cast<double>(level.mesh.cell_count()) * n;
  const auto scattered = [&](const std::vector<double>& whole) {
    double instances = static_cast<double>(whole.size()) / slice;
    context.comm.broadcast(instances);
    return scatter_from_root(context.comm, level.local.global_cell, whole,
                             static_cast<int>(std::lround(instances)), n);
  };
  stored.state.w = scattered(fields[0]);
  stored.state.y = stored.data[y_name];
  stored.state.omega = stored.data[omega_name].at(0);
  stored.state.r = stored.data[freestream_parameter_name].at(0);
  if (const auto stage = stored.text.find(stage_name); stage != stored.text.end()) {
    stored.memory = SolverMemory{stage->second, stored.data[memory_name], {}};
    for (std::size_t i = 1; i < fields.size(); ++i) stored.memory->fields.push_back(scattered(fields[i]));
  }
  judge(context, stored);
  if (is_own != 0.0 && stored.instances() > 1) context.checkpoints.stay_ahead();
  return stored;
}

AeroelasticState read_restart(const Context& context, const FlowLevel<2>& level,
                              const std::vector<int>& allowed_instances) {
  StoredSolution stored = read_stored_solution(context, level, *context.restart);
  if (stored.time_step())
    throw InputError(fmt::format("{}: holds time levels of a march; only wingbeat march goes on from these",
                                 context.restart->string()));
  if (std::ranges::find(allowed_instances, stored.instances()) == allowed_instances.end())
    throw InputError(
        fmt::format("{}: holds {} instances, this run can start from {}; set time.harmonics to match",
                    context.restart->string(), stored.instances(), fmt::join(allowed_instances, " or ")));
  if (stored.memory) context.checkpoints.remember(*std::move(stored.memory));
  return std::move(stored.state);
}

}  // namespace wingbeat
