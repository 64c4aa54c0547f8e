#include "apps/case_mesh.hpp"
#include "apps/cycle_record.hpp"
#include "apps/cycle_stage.hpp"
#include "apps/flow_setup.hpp"
#include "apps/solution_output.hpp"
#include "apps/verbs.hpp"

namespace wingbeat {

SolveStatus run_flutter(Context& context) {
  const CaseSettings& settings = context.settings;
  const StructureModel model = structure_model(typical_section(settings.structure));
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(settings.mesh));
  FlowLevel<2>& level = *levels.back();
  History history(context);
  CycleSolver solver(context, level, model, history);
  const double energy = settings.flutter.energy;
  const CycleApproach approach = approach_cycle(context, levels, model, solver, energy, history);
  if (!approach.start) return approach.status;

  const CycleSolution solution = solver.solve("flutter", *approach.start, GivenEnergy{energy});
  history.write();
  const auto part = context.timer.measure("output");
  write_solution_files(context, level, solution.state);
  const auto entry = cycle_entry(settings, model, solution);
  context.result.findings["flutter"] = entry;
  write_cycle(context, solution);
  print_cycle(context, entry);
  context.result.message = solution.status == SolveStatus::converged
                               ? fmt::format("V_F = {:.6f}, omega = {:.6f}",
                                             entry["reduced_velocity"].get<double>(), solution.state.omega)
                               : cycle_advice(settings, solution);
  return solution.status;
}

}  // namespace wingbeat
