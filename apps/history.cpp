#include "apps/history.hpp"

#include "apps/flow_setup.hpp"
#include "apps/on_root.hpp"

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

void History::cycle(const std::string& stage, const PseudoTimeIteration& i) {
  table_.add({stage, static_cast<long>(i.cycle), i.residual, std::string(), std::string(), std::string(),
              std::string(), std::string(), 0L, seconds()});
}

void History::staggered(const std::string& stage, const StaggeredIteration& i) {
  const AeroelasticResiduals& r = i.residuals;
  table_.add({stage, static_cast<long>(i.iteration), r.flow, r.structure, r.phase, r.energy, i.omega,
              i.reduced_velocity, 0L, seconds()});
}

void History::forced(const std::string& stage, const ForcedFlowIteration& i) {
  table_.add({stage, static_cast<long>(i.iteration), i.residual, std::string(), std::string(), std::string(),
              std::string(), std::string(), static_cast<long>(i.linear_iterations), seconds()});
}

void History::write() const {
  on_root(context_.comm, [&] { table_.write(context_.output / "history.csv"); });
}

}  // namespace wingbeat
