#pragma once

#include <vector>

#include "partition/partition.hpp"

namespace wingbeat {

// Divides the zones among ranks by recursive bisection: zones go to the lower half of the ranks
// in order, and the zone at the boundary is cut across its longest direction. No rank receives
// more than `limit` cells; where whole planes cannot keep to it, the last plane is cut as well.
// Needs ranks <= cells <= ranks x limit. The blocks are not merged.
template <int Dim>
std::vector<SubBlock<Dim>> bisect_recursively(const MultiblockMesh<Dim>& mesh, int ranks, std::size_t limit);

}  // namespace wingbeat
