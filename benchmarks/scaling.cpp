#include <fmt/core.h>

#include <algorithm>
#include <chrono>

#include "benchmarks/section_flow.hpp"

// Wall time of residual evaluation and Jacobian assembly on the ranks it is started on: the least
// of many calls, each timed by its slowest rank.
namespace wingbeat::benchmarks {
namespace {

template <class F>
double least_seconds(const Comm& comm, int calls, F&& f) {
  using Clock = std::chrono::steady_clock;
  double best = 1e30;
  for (int call = 0; call < calls; ++call) {
    comm.barrier();
    const auto start = Clock::now();
    f();
    best = std::min(best, comm.max(std::chrono::duration<double>(Clock::now() - start).count()));
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
  const double residual = least_seconds(comm, 400, [&] { flow.residual(r); });
  const double jacobian = least_seconds(comm, 40, [&] { flow.linearize(); });
  if (comm.is_root()) fmt::print("{} {:.6e} {:.6e}\n", comm.size(), residual, jacobian);
}
