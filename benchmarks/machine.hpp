#pragma once

#include <cstddef>

namespace wingbeat::benchmarks {

// What one core does a second, at best: the roofs that kernels are compared with.
struct MachineSpeed {
  double cache_bandwidth = 0.0;   // bytes: triad a = b + s c over arrays of the kernels' size
  double memory_bandwidth = 0.0;  // bytes: the same over arrays far beyond the caches
  double flops = 0.0;             // fused multiply-adds of packs held in registers, counted as two
  double divisions = 0.0;
  double roots = 0.0;
};

// `working_set`: bytes that the kernel compared with the cache bandwidth goes through.
MachineSpeed measure_machine(std::size_t working_set);

// CPU seconds of this thread: unlike wall time, unharmed by other programs on the core.
double cpu_seconds();

}  // namespace wingbeat::benchmarks
