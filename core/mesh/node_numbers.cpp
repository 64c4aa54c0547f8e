#include "core/mesh/node_numbers.hpp"

#include <numeric>
#include <utility>

#include "core/io/error.hpp"
#include "core/mesh/interface_transform.hpp"

namespace wingbeat {
namespace {

// Sets of copies, each known by its lowest member.
class Copies {
 public:
  explicit Copies(std::size_t count) : lower_(count) { std::iota(lower_.begin(), lower_.end(), 0U); }

  std::size_t lowest(std::size_t copy) {
    while (lower_[copy] != copy) copy = lower_[copy] = lower_[lower_[copy]];
    return copy;
  }
  void join(std::size_t a, std::size_t b) {
    a = lowest(a), b = lowest(b);
    if (a > b) std::swap(a, b);
    lower_[b] = a;
  }

 private:
  std::vector<std::size_t> lower_;
};

}  // namespace

template <int Dim>
NodeNumbers<Dim> number_nodes(const MultiblockMesh<Dim>& mesh) {
  NodeNumbers<Dim> numbers;
  std::vector<std::size_t> start{0};  // of each zone's copies, numbered as they lie in its array
  for (const Zone<Dim>& zone : mesh.zones) {
    numbers.zones.emplace_back(zone.nodes.extents(), 0);
    start.push_back(start.back() + numbers.zones.back().size());
  }
  Copies copies(start.back());
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    for (const Interface<Dim>& connection : mesh.zones[z].interfaces)
      for_each(connection.nodes, [&](const Index<Dim>& node) {
        const BlockArray<int, Dim>& donor = numbers.zones[connection.donor];
        copies.join(start[z] + numbers.zones[z].offset(node),
                    start[connection.donor] + donor.offset(donor_node<Dim>(connection, node)));
      });

  std::vector<int> number(start.back(), -1);  // of each lowest copy
  for (std::size_t z = 0; z < mesh.zones.size(); ++z) {
    BlockArray<int, Dim>& zone = numbers.zones[z];
    for_each(zone.interior(), [&](const Index<Dim>& node) {
      int& first = number[copies.lowest(start[z] + zone.offset(node))];
      if (first < 0) first = numbers.count++;
      zone(node) = first;
    });
  }
  return numbers;
}

template <int Dim>
std::vector<Vec<double, Dim>> unique_positions(const MultiblockMesh<Dim>& mesh,
                                               const NodeNumbers<Dim>& numbers) {
  std::vector<Vec<double, Dim>> positions(numbers.count);
  int next = 0;
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    for_each(numbers.zones[z].interior(), [&](const Index<Dim>& node) {
      if (numbers.zones[z](node) != next) return;
      positions[next++] = mesh.zones[z].nodes(node);
    });
  ensure(next == numbers.count, "node numbers of another mesh");
  return positions;
}

template <int Dim>
MultiblockMesh<Dim> with_positions(MultiblockMesh<Dim> mesh, const NodeNumbers<Dim>& numbers,
                                   std::span<const Vec<double, Dim>> positions) {
  ensure(std::ssize(positions) == numbers.count && mesh.zones.size() == numbers.zones.size(),
         "positions or node numbers of another mesh");
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    for_each(numbers.zones[z].interior(),
             [&](const Index<Dim>& node) { mesh.zones[z].nodes(node) = positions[numbers.zones[z](node)]; });
  return mesh;
}

template NodeNumbers<2> number_nodes<2>(const MultiblockMesh<2>&);
template NodeNumbers<3> number_nodes<3>(const MultiblockMesh<3>&);
template std::vector<Vec<double, 2>> unique_positions<2>(const MultiblockMesh<2>&, const NodeNumbers<2>&);
template std::vector<Vec<double, 3>> unique_positions<3>(const MultiblockMesh<3>&, const NodeNumbers<3>&);
template MultiblockMesh<2> with_positions<2>(MultiblockMesh<2>, const NodeNumbers<2>&,
                                             std::span<const Vec<double, 2>>);
template MultiblockMesh<3> with_positions<3>(MultiblockMesh<3>, const NodeNumbers<3>&,
                                             std::span<const Vec<double, 3>>);

}  // namespace wingbeat
