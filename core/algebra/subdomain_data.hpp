#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/algebra/ilu_pattern.hpp"
#include "core/algebra/schwarz.hpp"

namespace wingbeat {

// Cells are numbered owned first, then the overlap; rows and columns of the restricted pattern
// are numbered by elimination step.
struct Subdomain::Data {
  int owned_count = 0;
  int cell_count = 0;
  GhostExchange overlap_cells;            // overlap cell g is cell owned_count + g
  std::vector<int> order;                 // cell of each elimination step
  std::vector<int> row_begin;             // of each step, into columns and origins
  std::vector<int> columns;               // sorted steps
  std::size_t own_block_count = 0;        // blocks of the rank's own matrix
  GhostExchange overlap_blocks;           // fetches the blocks of the overlap's rows from their owners
  std::vector<int> origins;               // own block, or own_block_count + fetched block
  std::shared_ptr<const IluPattern> ilu;  // of the method ilu, else empty
};

}  // namespace wingbeat
