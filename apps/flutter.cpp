#include <algorithm>

#include "apps/case_mesh.hpp"
#include "apps/cycle_record.hpp"
#include "apps/cycle_stage.hpp"
#include "apps/flow_setup.hpp"
#include "apps/neighbour.hpp"
#include "apps/solution_output.hpp"
#include "apps/verbs.hpp"

namespace wingbeat {
namespace {

// The lowest of those that converged first.
void sort_by_speed(std::vector<CycleSolution>& solutions) {
  std::ranges::stable_sort(solutions, {}, [](const CycleSolution& solution) {
    return std::pair(solution.status != SolveStatus::converged, solution.state.r);
  });
}

// Roots that lie close together may lead to one cycle.
bool is_known(const std::vector<CycleSolution>& solutions, const CycleSolution& solution) {
  return std::ranges::any_of(solutions, [&](const CycleSolution& known) {
    return CycleRecord::is_same(known.state.omega, solution.state.omega) &&
           CycleRecord::is_same(known.state.r, solution.state.r);
  });
}

}  // namespace

SolveStatus run_flutter(Context& context) {
  const CaseSettings& settings = context.settings;
  const StructureModel model = structure_model(typical_section(settings.structure));
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(context.comm, settings.mesh));
  FlowLevel<2>& level = *levels.back();
  History history(context);
  CycleSolver solver(context, level, model, history);
  const double energy = settings.flutter.energy;
  const CycleApproach approach =
      approach_cycle(context, levels, model, solver, energy, history, settings.flutter.wants_all_roots());
  if (!approach.start) return approach.status;

  std::vector<CycleSolution> solutions{solver.solve("flutter", *approach.start, GivenEnergy{energy})};
  solver.keep_factors(*approach.start, solutions.front());
  for (const CycleStart& start : approach.further) {
    if (solutions.back().status == SolveStatus::interrupted) break;
    const std::string stage = fmt::format("flutter, root {}", solutions.size() + 1);
    CycleSolution solution = solver.solve(stage, start, GivenEnergy{energy});
    if (!is_known(solutions, solution)) solutions.push_back(std::move(solution));
  }
  const bool is_interrupted = solutions.back().status == SolveStatus::interrupted;
  sort_by_speed(solutions);
  history.write();

  const auto part = context.timer.measure("output");
  write_solution_files(context, level, solutions.front().state, solutions.front().memory);
  auto points = nlohmann::ordered_json::array();
  for (const CycleSolution& solution : solutions) {
    points.push_back(cycle_entry(settings, model, solution));
    if (points.size() > 1)
      write_checkpoint(context, level, solution.state, std::nullopt,
                       flutter_file(static_cast<int>(points.size())));
  }
  context.result.findings["flutter"] = points[0];
  if (settings.flutter.wants_all_roots()) context.result.findings["flutter_points"] = points;
  write_cycle(context, solutions.front());
  for (const auto& point : points) print_cycle(context, point);

  const SolveStatus status = is_interrupted ? SolveStatus::interrupted : solutions.front().status;
  std::string& message = context.result.message;
  message = status == SolveStatus::converged
                ? fmt::format("V_F = {:.6f}, omega = {:.6f}", points[0]["reduced_velocity"].get<double>(),
                              solutions.front().state.omega)
                : cycle_advice(settings, is_interrupted ? solutions.back() : solutions.front());
  const auto failed = std::ranges::count_if(
      solutions, [](const CycleSolution& solution) { return solution.status != SolveStatus::converged; });
  if (status == SolveStatus::converged && failed > 0)
    message += fmt::format("; of {} roots above it {} did not converge", solutions.size() - 1, failed);
  return status;
}

}  // namespace wingbeat
