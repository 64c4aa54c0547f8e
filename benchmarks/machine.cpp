#include "benchmarks/machine.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <vector>

#include "core/number/math.hpp"

namespace wingbeat::benchmarks {
namespace {

// CPU seconds of the quickest of several calls.
template <class F>
double quickest(int calls, F&& f) {
  double best = 1e30;
  for (int call = 0; call < calls; ++call) {
    const double start = cpu_seconds();
    f();
    best = std::min(best, cpu_seconds() - start);
  }
  return best;
}

double triad_bandwidth(std::size_t working_set) {
  const std::size_t count = working_set / (3 * sizeof(double));
  std::vector<double> a(count, 0.0), b(count, 1.0), c(count, 2.0);
  // Long enough for the clock, however small the arrays.
  const int sweeps = static_cast<int>(std::max<std::size_t>(1, (std::size_t{64} << 20) / working_set));
  const double seconds = quickest(20, [&] {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for (std::size_t i = 0; i < count; ++i) a[i] = b[i] + 3.0 * c[i];
      benchmark::ClobberMemory();
    }
  });
  return 3.0 * sizeof(double) * static_cast<double>(count) * sweeps / seconds;
}

// Operations a second of `operation` on packs, `Chains` independent ones at a time.
template <int Chains, class F>
double throughput(F&& operation) {
  constexpr int steps = 100000;
  std::array<Pack, Chains> x;
  for (int i = 0; i < Chains; ++i) x[static_cast<std::size_t>(i)] = Pack(1.0 + 0.01 * i);
  const double seconds = quickest(20, [&] {
    for (int step = 0; step < steps; ++step)
      for (Pack& value : x) operation(value);
    benchmark::DoNotOptimize(x);
  });
  return static_cast<double>(steps) * Chains * lanes<Pack> / seconds;
}

}  // namespace

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

MachineSpeed measure_machine(std::size_t working_set) {
  MachineSpeed speed;
  speed.cache_bandwidth = triad_bandwidth(working_set);
  speed.memory_bandwidth = triad_bandwidth(std::size_t{256} << 20);
  speed.flops = 2.0 * throughput<12>([](Pack& x) { x = x * 0.999 + 0.001; });
  speed.divisions = throughput<8>([](Pack& x) { x = 1.1 / x; });
  speed.roots = throughput<8>([](Pack& x) { x = sqrt(x); });
  return speed;
}

}  // namespace wingbeat::benchmarks
