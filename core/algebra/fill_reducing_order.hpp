#pragma once

#include <span>
#include <vector>

namespace wingbeat {

// Elimination order of the cells of a block-sparse matrix that keeps the fill of its LU small:
// METIS nested dissection of the graph of A + A^T, then a postorder of the elimination tree, which
// changes no fill but keeps each cell close to those it updates. order[q] is eliminated q-th.
// Deterministic. Throws InternalError when METIS fails.
std::vector<int> fill_reducing_order(std::span<const int> row_begin, std::span<const int> columns);

}  // namespace wingbeat
