#include "benchmarks/kernel_table.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "benchmarks/operation_count.hpp"

namespace wingbeat::benchmarks {
namespace {

double counter(const benchmark::BenchmarkReporter::Run& run, const char* name, double otherwise) {
  const auto found = run.counters.find(name);
  return found == run.counters.end() ? otherwise : found->second.value;
}

}  // namespace

bool KernelTable::ReportContext(const Context& context) {
  PrintBasicContext(&GetErrorStream(), context);
  return true;
}

void KernelTable::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
    const double seconds = run.cpu_accumulated_time / static_cast<double>(run.iterations);
    Kernel& kernel = kernels_[run.run_name.function_name];
    if (kernel.seconds == 0.0 || seconds < kernel.seconds)
      kernel = {seconds, counter(run, "cells", 1.0), counter(run, "bytes", 0.0)};
  }
}

void KernelTable::print(const MachineSpeed& machine) const {
  fmt::print(
      "one core: triad {:.1f} GB/s in cache, {:.1f} GB/s in memory; {:.1f} GFlop/s; {:.2f} G divisions/s, "
      "{:.2f} G roots/s\n\n",
      machine.cache_bandwidth * 1e-9, machine.memory_bandwidth * 1e-9, machine.flops * 1e-9,
      machine.divisions * 1e-9, machine.roots * 1e-9);
  const auto reference = kernels_.find("residual/250x50");
  fmt::print("{:<36} {:>12} {:>12} {:>11} {:>14}\n", "CPU time, least of all repetitions", "ns a cell",
             "ms in all", "residuals", "of the triad");
  for (const auto& [name, kernel] : kernels_) {
    const double a_cell = kernel.seconds / kernel.cells;
    fmt::print("{:<36} {:>12.1f} {:>12.3f}", name, a_cell * 1e9, kernel.seconds * 1e3);
    if (reference != kernels_.end())
      fmt::print(" {:>11.1f}", a_cell * reference->second.cells / reference->second.seconds);
    if (kernel.bytes > 0.0)
      fmt::print(" {:>13.0f}%", 100.0 * kernel.bytes / kernel.seconds / machine.memory_bandwidth);
    fmt::print("\n");
  }
  if (reference != kernels_.end()) print_roofline(machine);
}

void KernelTable::print_roofline(const MachineSpeed& machine) const {
  const Kernel& residual = kernels_.at("residual/250x50");
  const OperationCount operations = residual_operations<2>();
  const double bytes = 8.0 * residual_values<2>();
  const double measured = residual.seconds / residual.cells;
  const double moving = bytes / machine.cache_bandwidth;
  const double computing = operations.additions_and_multiplications / machine.flops;
  const double dividing = operations.divisions / machine.divisions + operations.roots / machine.roots;
  fmt::print("\nroofline of residual/250x50, ns a cell\n");
  fmt::print("{:>8.1f}  measured\n", measured * 1e9);
  fmt::print("{:>8.1f}  moving {:.0f} bytes\n", moving * 1e9, bytes);
  fmt::print("{:>8.1f}  adding and multiplying {:.0f} times\n", computing * 1e9,
             operations.additions_and_multiplications);
  fmt::print("{:>8.1f}  dividing {:.0f} times, taking {:.0f} roots\n", dividing * 1e9, operations.divisions,
             operations.roots);
  fmt::print("{:>8.2f}  roof (the largest) / measured\n", std::max({moving, computing, dividing}) / measured);
}

}  // namespace wingbeat::benchmarks
