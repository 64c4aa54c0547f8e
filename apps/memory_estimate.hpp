#pragma once

#include <cstddef>
#include <string>

#include "apps/case_settings.hpp"
#include "partition/partition.hpp"

namespace wingbeat {

// The most memory that a run will hold, in bytes: of the largest rank, and of all together.
struct MemoryEstimate {
  double largest_rank = 0.0;
  double all_ranks = 0.0;
};

// That of a verb on a plane mesh of so many cells, partitioned as the statistics tell. Sums what is held of a
// cell, as measured; within 20 % of the peak (docs/performance.md, memory). `process`: what a rank holds
// before.
MemoryEstimate estimate_memory(const std::string& verb, const CaseSettings& settings, std::size_t cells,
                               const PartitionStatistics& partition, double process);

// "928 MB on 2 ranks, 465 MB on the largest", or "904 MB" where there is one.
std::string memory_text(const MemoryEstimate& estimate, int ranks);

}  // namespace wingbeat
