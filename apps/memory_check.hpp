#pragma once

#include <cstddef>

#include "apps/context.hpp"
#include "partition/partition.hpp"

namespace wingbeat {

// Says how much memory the run will take and throws InputError where this node has not as much, even if the
// estimate is a fifth too high; warns where it may not have. To be called before the bulk of it is taken.
// `process`: what this rank held before it took anything of the mesh's size, in bytes. Collective.
void check_memory(Context& context, std::size_t cells, const PartitionStatistics& partition, double process);

}  // namespace wingbeat
