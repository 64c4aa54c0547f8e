#include "core/algebra/adjacency_graph.hpp"

#include <algorithm>

namespace wingbeat {

AdjacencyGraph symmetric_graph(std::span<const int> row_begin, std::span<const int> columns) {
  const int n = static_cast<int>(row_begin.size()) - 1;
  std::vector<std::vector<int>> adjacent(n);
  for (int row = 0; row < n; ++row) {
    for (int k = row_begin[row]; k < row_begin[row + 1]; ++k) {
      if (columns[k] == row) continue;
      adjacent[row].push_back(columns[k]);
      adjacent[columns[k]].push_back(row);
    }
  }
  AdjacencyGraph graph{.begin = {0}, .neighbours = {}};
  for (auto& list : adjacent) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    graph.neighbours.insert(graph.neighbours.end(), list.begin(), list.end());
    graph.begin.push_back(static_cast<int>(graph.neighbours.size()));
  }
  return graph;
}

}  // namespace wingbeat
