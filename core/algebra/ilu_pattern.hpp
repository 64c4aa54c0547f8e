#pragma once

#include <span>
#include <vector>

namespace wingbeat {

// Where an incomplete LU keeps entries: compressed rows of L + U with sorted columns.
struct IluPattern {
  std::vector<int> row_begin;
  std::vector<int> columns;
  std::vector<int> diagonal;   // position of each row's diagonal
  std::vector<int> positions;  // of each entry of the matrix

  int row_count() const { return static_cast<int>(diagonal.size()); }
};

// The pattern of ILU(k) (eq:block-ilu; Saad 2003, doi:10.1137/1.9780898718003, section 10.3): entries of
// the matrix have level 0, fill that row k brings to (i, j) has level_ik + level_kj + 1, and what is
// above `fill` is dropped. Compressed rows of the matrix with sorted columns, every row with its
// diagonal; rows are eliminated in their order. Throws InternalError where a diagonal is missing.
IluPattern ilu_pattern(std::span<const int> row_begin, std::span<const int> columns, int fill);

}  // namespace wingbeat
