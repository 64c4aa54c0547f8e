#pragma once

#include <span>
#include <vector>

#include "core/parallel/comm.hpp"

namespace wingbeat {

// Fields of owned cells, [instance][owned cell][width], to and from the whole mesh on rank 0,
// [instance][cell][width] with cells zone by zone: the same for any number of ranks.
// `global_cell` is the number of each owned cell in the whole mesh (LocalMesh::global_cell).

// Collective. The whole field on rank 0, empty elsewhere.
std::vector<double> gather_to_root(const Comm& comm, std::span<const long> global_cell,
                                   std::span<const double> owned, int instances, int width);

// Collective, the inverse: `whole` counts on rank 0 alone.
std::vector<double> scatter_from_root(const Comm& comm, std::span<const long> global_cell,
                                      std::span<const double> whole, int instances, int width);

}  // namespace wingbeat
