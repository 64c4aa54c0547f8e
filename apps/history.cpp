#include "apps/history.hpp"

#include <memory>

#include "apps/flow_setup.hpp"
#include "apps/on_root.hpp"
#include "core/io/progress.hpp"

namespace wingbeat {

History::History(Context& context)
    : context_(context),
      start_(std::chrono::steady_clock::now()),
      table_({"stage", "iteration", "flow", "structure", "phase", "energy", "omega", "reduced_velocity",
              "linear_iterations", "seconds"}) {}

double History::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void History::steady(const std::string& mesh, const PseudoTransientIteration& i) {
  table_.add({"steady " + mesh, static_cast<long>(i.iteration), i.residual, std::string(), std::string(),
              std::string(), std::string(), std::string(), static_cast<long>(i.linear_iterations),
              seconds()});
}

void History::coupled(const std::string& stage, const NewtonIteration& i, const AeroelasticResiduals& r,
                      double omega, double reduced_velocity) {
  table_.add({stage, static_cast<long>(i.iteration), r.flow, r.structure, r.phase, r.energy, omega,
              reduced_velocity, static_cast<long>(i.linear_iterations), seconds()});
}

void History::write() const {
  on_root(context_.comm, [&] { table_.write(context_.output / "history.csv"); });
}

PseudoTransientResult solve_steady_with_progress(Context& context, FlowLevels<2>& levels,
                                                 const MotionState& motion, History& history) {
  const auto part = context.timer.measure("steady");
  const PseudoTransientOptions options = steady_options(context.settings.solver);
  std::unique_ptr<Progress> progress;
  std::size_t shown = levels.size();
  PseudoTransientResult result =
      solve_steady<2>(levels, motion, options, [&](std::size_t level, const PseudoTransientIteration& i) {
        const std::string mesh = mesh_size_text<2>(levels[level]->mesh);
        if (level != shown) {
          progress.reset();
          progress =
              std::make_unique<Progress>(context.log, "steady flow, " + mesh,
                                         std::vector<std::string>{"iter", "|R|", "CFL", "step", "linear"});
          shown = level;
        }
        history.steady(mesh, i);
        progress->row(
            {fmt::format("{}", i.iteration), fmt::format("{:.2e}", i.residual), fmt::format("{:.1e}", i.cfl),
             fmt::format("{:.2f}", i.step), fmt::format("{}", i.linear_iterations)},
            converged_fraction(1.0, i.residual, options.tolerance));
        return !context.stop.is_set();
      });
  return result;
}

}  // namespace wingbeat
