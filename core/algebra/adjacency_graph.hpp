#pragma once

#include <span>
#include <vector>

namespace wingbeat {

// An undirected graph, compressed: the neighbours of each vertex, sorted, without itself.
struct AdjacencyGraph {
  std::vector<int> begin;
  std::vector<int> neighbours;

  int size() const { return static_cast<int>(begin.size()) - 1; }
  std::span<const int> of(int vertex) const {
    return std::span(neighbours).subspan(begin[vertex], begin[vertex + 1] - begin[vertex]);
  }
};

// The graph of A + A^T without its diagonal, of compressed rows of A.
AdjacencyGraph symmetric_graph(std::span<const int> row_begin, std::span<const int> columns);

}  // namespace wingbeat
