#include "apps/case_mesh.hpp"
#include "apps/flow_setup.hpp"
#include "apps/restart.hpp"
#include "apps/steady_stage.hpp"
#include "apps/verbs.hpp"

namespace wingbeat {

SolveStatus run_steady(Context& context) {
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(context.comm, context.settings.mesh));
  if (context.restart) levels.back()->w = read_restart(context, *levels.back(), {1}).w;
  History history(context);
  return run_steady_stage(context, levels, history);
}

}  // namespace wingbeat
