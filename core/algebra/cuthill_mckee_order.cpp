#include "core/algebra/cuthill_mckee_order.hpp"

#include <algorithm>

#include "core/algebra/adjacency_graph.hpp"

namespace wingbeat {
namespace {

// Vertices reached from `start`, nearest first, and where the farthest layer begins among them.
struct Layers {
  std::vector<int> vertices;
  std::size_t last_begin = 0;
  int count = 0;
};

// Breadth first, the neighbours of each vertex by rising degree. `mark[v] == stamp` tells those seen.
Layers layers_from(const AdjacencyGraph& graph, int start, std::vector<int>& mark, int stamp) {
  Layers layers{.vertices = {start}};
  mark[start] = stamp;
  for (std::size_t begin = 0; begin < layers.vertices.size();) {
    const std::size_t end = layers.vertices.size();
    layers.last_begin = begin;
    ++layers.count;
    for (; begin < end; ++begin) {
      const std::size_t first_new = layers.vertices.size();
      for (const int neighbour : graph.of(layers.vertices[begin]))
        if (mark[neighbour] != stamp) {
          mark[neighbour] = stamp;
          layers.vertices.push_back(neighbour);
        }
      std::stable_sort(layers.vertices.begin() + static_cast<std::ptrdiff_t>(first_new),
                       layers.vertices.end(),
                       [&](int a, int b) { return graph.of(a).size() < graph.of(b).size(); });
    }
  }
  return layers;
}

}  // namespace

std::vector<int> cuthill_mckee_order(std::span<const int> row_begin, std::span<const int> columns) {
  const AdjacencyGraph graph = symmetric_graph(row_begin, columns);
  std::vector<int> order, mark(graph.size(), 0);
  std::vector<bool> is_placed(graph.size(), false);
  int stamp = 0;
  for (int seed = 0; seed < graph.size(); ++seed) {
    if (is_placed[seed]) continue;
    Layers layers = layers_from(graph, seed, mark, ++stamp);
    // From the far end of what is reached, as long as that is farther still (George & Liu 1979,
    // doi:10.1145/355841.355845).
    for (;;) {
      const auto far = std::min_element(
          layers.vertices.begin() + static_cast<std::ptrdiff_t>(layers.last_begin), layers.vertices.end(),
          [&](int a, int b) { return graph.of(a).size() < graph.of(b).size(); });
      Layers farther = layers_from(graph, *far, mark, ++stamp);
      const bool is_better = farther.count > layers.count;
      if (is_better) layers = std::move(farther);
      if (!is_better) break;
    }
    for (const int vertex : layers.vertices) is_placed[vertex] = true;
    order.insert(order.end(), layers.vertices.begin(), layers.vertices.end());
  }
  return order;
}

}  // namespace wingbeat
