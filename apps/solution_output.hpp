#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/context.hpp"
#include "core/io/csv.hpp"
#include "flow/flow_level.hpp"
#include "flow/surface.hpp"
#include "structure/aeroelastic_problem.hpp"

namespace wingbeat {

// Writes solution.cgns (all instances, moved meshes, the restart data), surface.csv and mesh.csv into
// the case's folder. Steady flow is one instance. Collective.
void write_solution_files(const Context& context, const FlowLevel<2>& level, const AeroelasticState& state);
// The same in a CGNS file of another name alone. Collective.
void write_further_solution(const Context& context, const FlowLevel<2>& level, const AeroelasticState& state,
                            const std::string& name);

// Time levels of a march, newest first, dtau apart. Instances of solution.cgns are in the same order, their
// time counts back from the end of the march.
struct TimeLevels {
  std::vector<std::vector<double>> w;
  std::vector<std::vector<double>> y;
  double dtau = 0.0;
  double reduced_velocity = 0.0;
  std::vector<double> rest_y;  // the section at rest at that speed
};
// Writes solution.cgns and mesh.csv. Collective.
void write_time_levels(const Context& context, const FlowLevel<2>& level, const TimeLevels& levels);

// Pressure on the walls, instance by instance: surface.csv.
class SurfaceTable {
 public:
  SurfaceTable();
  // The walls of a flow w of the level with the section at y. Collective.
  void add(const Context& context, const FlowLevel<2>& level, double phase, std::span<const double> w,
           std::span<const double> y);
  long instances() const { return instances_; }
  void write(const Context& context) const;

 private:
  CsvTable table_;
  long instances_ = 0;
};

// What solution.cgns of an earlier run on the same mesh holds: one instance, a period, or time levels of a
// march with their distance in time. Throws InputError when it is of another mesh. Collective.
struct StoredSolution {
  AeroelasticState state;
  std::optional<double> time_step;  // of a march, whose levels then stand in place of instances
  std::vector<double> rest_y;       // of a march
  double mach = 0.0;
  int instances() const { return static_cast<int>(state.y.size() / 4); }
};
StoredSolution read_stored_solution(const Context& context, const FlowLevel<2>& level,
                                    const std::filesystem::path& file);

// The state that solution.cgns of an earlier run on the same mesh holds. Throws InputError when it is of
// another mesh or holds a number of instances that is not among those allowed. Collective.
AeroelasticState read_restart(const Context& context, const FlowLevel<2>& level,
                              const std::vector<int>& allowed_instances);

}  // namespace wingbeat
