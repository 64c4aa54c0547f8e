#pragma once

#include <array>
#include <vector>

#include "core/parallel/ghost_exchange.hpp"
#include "flow/flow_domain.hpp"

namespace wingbeat {

// The lines of a block along one direction. Cells lie as [outer][position][inner], inner fastest;
// line number `outer * inner count + inner`.
struct MeshLines {
  int first_cell = 0;
  int inner = 1;
  int length = 1;
  int outer = 1;

  int count() const { return inner * outer; }
  std::size_t cell_count() const {
    return static_cast<std::size_t>(count()) * static_cast<std::size_t>(length);
  }
  // Number of a cell of a line, counted from the block's first.
  std::size_t cell(int line, int position) const {
    return (static_cast<std::size_t>(line / inner) * static_cast<std::size_t>(length) +
            static_cast<std::size_t>(position)) *
               static_cast<std::size_t>(inner) +
           static_cast<std::size_t>(line % inner);
  }
  int end_position(int end) const { return end == 0 ? 0 : length - 1; }
};

template <int Dim>
MeshLines mesh_lines(const FlowBlock<Dim>& block, int direction);

// The ends of all lines of one direction on a rank that meet other blocks, and what meets them.
struct LineEnds {
  // [block][end]: number of the end of the block's line 0, the ends of its other lines follow; -1
  // where no line of the block goes on.
  std::vector<std::array<int, 2>> first;
  int count = 0;
  // Fetches the values of the ends opposite. An end without one (physical boundary, or a
  // neighbour that calls the direction by another index) fetches its own values.
  GhostExchange exchange;
};

// Of every direction. Collective.
template <int Dim>
std::array<LineEnds, Dim> connect_lines(const FlowDomain<Dim>& domain);

}  // namespace wingbeat
