#pragma once

#include "core/parallel/comm.hpp"

namespace wingbeat {

// How many ranks of the group share this rank's memory. Collective.
int ranks_on_node(const Comm& comm);

}  // namespace wingbeat
