#include <fmt/core.h>

#include <algorithm>
#include <chrono>

#include "benchmarks/machine.hpp"
#include "benchmarks/section_flow.hpp"
#include "flow/multigrid.hpp"

// Residual, Jacobian and multigrid W cycle of seven instances on the ranks it is started on: the
// least of many calls, each timed by its slowest rank.
namespace wingbeat::benchmarks {
namespace {

constexpr int harmonics = 3;

// Wall time is what counts on a quiet machine. CPU time leaves out what other programs take, and
// all waiting that is not done by polling.
struct Seconds {
  double wall = 1e30, cpu = 1e30;
};

template <class F>
Seconds least_seconds(const Comm& comm, int calls, F&& f) {
  using Clock = std::chrono::steady_clock;
  Seconds best;
  for (int call = 0; call < calls; ++call) {
    comm.barrier();
    const auto start = Clock::now();
    const double cpu_start = cpu_seconds();
    f();
    const double cpu = cpu_seconds() - cpu_start;
    const double wall = std::chrono::duration<double>(Clock::now() - start).count();
    best.wall = std::min(best.wall, comm.max(wall));
    best.cpu = std::min(best.cpu, comm.max(cpu));
  }
  return best;
}

void print(const Comm& comm, const char* what, const Seconds& seconds) {
  if (comm.is_root()) fmt::print("{} {} {:.6e} {:.6e}\n", what, comm.size(), seconds.wall, seconds.cpu);
}

Seconds w_cycle(const Comm& comm, int around, int normal) {
  const MultigridOptions options;
  SectionFlow flow(comm, around, normal, harmonics);
  Multigrid<2> multigrid(flow.equations, {flow.level.mesh, flow.level.partition}, options);
  const std::vector<double> start = flow.w;
  return least_seconds(comm, 8, [&] {
    flow.w = start;
    multigrid.cycle(flow.w, flow.motions, flow.kappa, options.runge_kutta);
  });
}

}  // namespace
}  // namespace wingbeat::benchmarks

int main(int argc, char** argv) {
  using namespace wingbeat;
  using namespace wingbeat::benchmarks;
  const MpiSession session(argc, argv);
  const Comm comm;
  {
    SectionFlow flow(comm, 512, 128, 0);
    std::vector<double> r(flow.w.size());
    print(comm, "residual", least_seconds(comm, 400, [&] { flow.residual(r); }));
    print(comm, "jacobian", least_seconds(comm, 60, [&] { flow.linearize(); }));
  }
  print(comm, "cycle", w_cycle(comm, 512, 128));
  // As many cells a rank on any number of ranks.
  print(comm, "cycle-weak", w_cycle(comm, 256 * comm.size(), 128));
}
