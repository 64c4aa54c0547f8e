#pragma once

#include <span>
#include <vector>

namespace wingbeat {

// Cuthill-McKee order of the cells of a block-sparse matrix (1969, doi:10.1145/800195.805928): by layers
// of the graph of A + A^T from a cell at its edge, so that neighbours are eliminated near to each other
// and an incomplete LU loses little. Not reversed: what the reverse saves in an exact LU is of no use
// here, and it took more iterations. order[q] is eliminated q-th. Compressed rows. Deterministic.
std::vector<int> cuthill_mckee_order(std::span<const int> row_begin, std::span<const int> columns);

}  // namespace wingbeat
