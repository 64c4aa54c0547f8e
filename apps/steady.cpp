#include "apps/advice.hpp"
#include "apps/case_mesh.hpp"
#include "apps/flow_setup.hpp"
#include "apps/history.hpp"
#include "apps/solution_output.hpp"
#include "apps/verbs.hpp"

namespace wingbeat {

SolveStatus run_steady(Context& context) {
  const MultiblockMesh<2> mesh = make_plane_mesh(context.settings.mesh);
  FlowLevels<2> levels = make_levels<2>(context, mesh);
  FlowLevel<2>& level = *levels.back();
  if (context.restart) level.w = read_restart(context, level, 1).w;

  const MotionState motion{section_kinematics(context.settings).mean_pitch, 0.0, 0.0};
  History history(context);
  const PseudoTransientResult solved = solve_steady_with_progress(context, levels, motion, history);
  history.write();
  if (level.w.empty()) {
    context.result.message =
        "stopped by a signal or --walltime before the finest mesh was reached; there is nothing to restart "
        "from: "
        "run again with more time";
    return solved.status;
  }
  context.result.message = steady_advice(solved.status, context.settings.solver);
  if (solved.status == SolveStatus::interrupted)
    context.result.message = "stopped by a signal or --walltime; continue with --restart solution.cgns";

  const auto part = context.timer.measure("output");
  write_solution_files(context, level, {level.w, std::vector<double>(4, 0.0), 0.0, 1.0});
  report_steady(context, level, motion, solved);
  return solved.status;
}

}  // namespace wingbeat
