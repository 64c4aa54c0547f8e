#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "benchmarks/machine.hpp"

namespace wingbeat::benchmarks {

// Keeps the least CPU seconds of each benchmark over its repetitions, and says what they mean.
class KernelTable final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;

  // Benchmarks that were not run are left out. `cells` of a benchmark is its counter of that name.
  void print(const MachineSpeed& machine) const;

 private:
  struct Kernel {
    double seconds = 0.0;
    double cells = 1.0;
    double bytes = 0.0;  // moved between the kernel and memory, if it says so
  };
  void print_roofline(const MachineSpeed& machine) const;

  std::map<std::string, Kernel> kernels_;
};

}  // namespace wingbeat::benchmarks
