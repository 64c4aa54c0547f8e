#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/context.hpp"
#include "flow/flow_level.hpp"
#include "structure/aeroelastic_problem.hpp"

namespace wingbeat {

// What solution.cgns of an earlier run on the same mesh holds: one instance, a period, or time levels of a
// march with their distance in time.
struct StoredSolution {
  AeroelasticState state;
  std::map<std::string, std::vector<double>> data;  // whatever else was stored, by name
  std::map<std::string, std::string> text;
  std::optional<SolverMemory> memory;  // where the run goes on with it
  bool is_same_problem = false;  // the run had the same case but for keys that only say how it is solved

  int instances() const { return static_cast<int>(state.y.size() / 4); }
  // Of a march, whose levels stand in place of instances.
  std::optional<double> time_step() const;
  std::vector<double> rest_y() const;
};

// Reads a solution, a restart or a neighbour: on any number of ranks, and with the mesh cut into any blocks.
// Where the context asks for it, keys that differ from the case of the earlier run are told, and a solution
// of another mesh is refused. Throws InputError saying why the file cannot be used. Collective.
StoredSolution read_stored_solution(const Context& context, const FlowLevel<2>& level,
                                    const std::filesystem::path& path);

// The state of a restart for an iteration to start from or, where it had not ended, to go on with: its memory
// goes to context.checkpoints. Throws InputError also where it holds a number of instances that is not among
// those allowed. Collective.
AeroelasticState read_restart(const Context& context, const FlowLevel<2>& level,
                              const std::vector<int>& allowed_instances);

}  // namespace wingbeat
