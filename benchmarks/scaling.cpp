#include <fmt/core.h>

#include <algorithm>
#include <chrono>

#include "benchmarks/machine.hpp"
#include "benchmarks/section_flow.hpp"

// Residual evaluation and Jacobian assembly on the ranks it is started on: the least of many calls,
// each timed by its slowest rank.
namespace wingbeat::benchmarks {
namespace {

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

}  // namespace
}  // namespace wingbeat::benchmarks

int main(int argc, char** argv) {
  using namespace wingbeat;
  using namespace wingbeat::benchmarks;
  const MpiSession session(argc, argv);
  const Comm comm;
  SectionFlow flow(comm, 512, 128, 0);
  std::vector<double> r(flow.w.size());
  const Seconds residual = least_seconds(comm, 400, [&] { flow.residual(r); });
  const Seconds jacobian = least_seconds(comm, 60, [&] { flow.linearize(); });
  if (comm.is_root()) {
    fmt::print("residual {} {:.6e} {:.6e}\n", comm.size(), residual.wall, residual.cpu);
    fmt::print("jacobian {} {:.6e} {:.6e}\n", comm.size(), jacobian.wall, jacobian.cpu);
  }
}
