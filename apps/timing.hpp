#pragma once

#include <string>
#include <vector>

#include "core/io/timer.hpp"
#include "core/parallel/comm.hpp"

namespace wingbeat {

// Wall seconds of one part of a run over the ranks.
struct PartTiming {
  std::string path;
  int depth = 0;
  long count = 0;
  double minimum = 0.0, mean = 0.0, maximum = 0.0;
};

// The parts that rank 0 measured, over all ranks, the whole run ("total") first. Collective.
std::vector<PartTiming> gather_timings(const Comm& comm, const Timer& timer);

// A table, one line a part.
std::string timing_table(const std::vector<PartTiming>& timings);

}  // namespace wingbeat
