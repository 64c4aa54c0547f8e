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

// Writes solution.cgns, or a file of another name, into the case's folder: all instances, moved meshes, and
// what a restart needs, the solver's memory where its iteration has not ended. Steady flow is one instance.
// Collective.
void write_checkpoint(const Context& context, const FlowLevel<2>& level, const AeroelasticState& state,
                      const std::optional<SolverMemory>& memory = {},
                      const std::string& name = "solution.cgns");
// The same at the end of a stage, with surface.csv and mesh.csv. Collective.
void write_solution_files(const Context& context, const FlowLevel<2>& level, const AeroelasticState& state,
                          const std::optional<SolverMemory>& memory = {});

// How far a march has come, beside its levels.
struct MarchProgress {
  std::vector<double> record;  // structural states from its start on: [step][state]
  std::vector<double> rows;    // of march.csv; rank 0
  std::vector<double> search;  // with --find-flutter: speeds done with, as its recipe keeps them
  std::string entries;         // and what result.json says of them
  std::optional<SolverMemory> memory;
};

// Time levels of a march, newest first, dtau apart. Instances of solution.cgns are in the same order, their
// time counts back from the end of the march.
struct TimeLevels {
  std::vector<std::vector<double>> w;
  std::vector<std::vector<double>> y;
  double dtau = 0.0;
  double reduced_velocity = 0.0;
  std::vector<double> rest_y;  // the section at rest at that speed
  MarchProgress progress{};
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

}  // namespace wingbeat
