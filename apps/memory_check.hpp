#pragma once

#include <cstddef>

#include "apps/context.hpp"
#include "partition/partition.hpp"

namespace wingbeat {

// Says how much memory the run will take and throws InputError where the node, or the limit of a rank's
// address space, has not as much, even if the estimate is a fifth too high; warns where it may not have. To
// be called before anything of the mesh's size but the mesh itself is taken. Collective.
void check_memory(Context& context, std::size_t cells, const PartitionStatistics& partition);

}  // namespace wingbeat
