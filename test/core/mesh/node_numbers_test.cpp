#include "core/mesh/node_numbers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/io/error.hpp"
#include "core/mesh/airfoil.hpp"
#include "core/mesh/conformal_omesh.hpp"
#include "core/mesh/cut_blocks.hpp"
#include "test/core/mesh/example_meshes.hpp"
#include "test/partition/lattice_mesh.hpp"

namespace wingbeat {
namespace {

template <int Dim>
std::vector<std::array<double, Dim>> sorted_positions(const MultiblockMesh<Dim>& mesh) {
  std::vector<std::array<double, Dim>> positions;
  for (const auto& x : unique_positions(mesh, number_nodes(mesh))) positions.push_back(x.components);
  std::ranges::sort(positions);
  return positions;
}

// Two copies have one number exactly if they are one node of the lattice.
template <int Dim>
void expect_lattice_nodes(const LatticeMesh<Dim>& lattice, bool closed) {
  const NodeNumbers<Dim> numbers = number_nodes(lattice.mesh());
  std::map<Index<Dim>, int> seen;
  for (std::size_t z = 0; z < numbers.zones.size(); ++z)
    for_each(numbers.zones[z].interior(), [&](const Index<Dim>& node) {
      Index<Dim> place = lattice.lattice_node(static_cast<int>(z), node);
      if (closed) place[0] %= lattice.cells()[0];
      const int number = numbers.zones[z](node);
      EXPECT_EQ(seen.emplace(place, number).first->second, number);
    });
  EXPECT_EQ(std::ssize(seen), numbers.count);
  std::vector<int> used;
  for (const auto& [place, number] : seen) used.push_back(number);
  std::ranges::sort(used);
  for (int n = 0; n < numbers.count; ++n) EXPECT_EQ(used[n], n);
}

TEST(NodeNumbers, JoinCopiesAcrossAnyOrientationAndAtCorners) {
  expect_lattice_nodes(single_ring(17, 5), true);
  expect_lattice_nodes(turned_ring(), true);
  expect_lattice_nodes(turned_box(), false);
  expect_lattice_nodes(turned_shell(), true);
}

TEST(NodeNumbers, NodesAreTheSameHoweverTheMeshIsCut) {
  const MultiblockMesh<2> whole = conformal_omesh(make_airfoil("naca0012"), {.around = 64, .normal = 16});
  EXPECT_EQ(number_nodes(whole).count, 64 * 17);
  const auto expected = sorted_positions(whole);
  for (const int blocks : {2, 5, 12})
    EXPECT_EQ(sorted_positions(cut_blocks(whole, blocks)), expected) << blocks << " blocks";
  const MultiblockMesh<3> box = example::row_of_blocks<3>(2, {5, 4, 3});
  EXPECT_EQ(number_nodes(box).count, 11 * 5 * 4);
  EXPECT_EQ(sorted_positions(cut_blocks(box, 9)), sorted_positions(box));
}

TEST(NodeNumbers, AllCopiesOfANodeMoveTogether) {
  const MultiblockMesh<2> mesh = cut_blocks(example::ring(12, 5), 6);
  const NodeNumbers<2> numbers = number_nodes(mesh);
  std::vector<Vec<double, 2>> positions = unique_positions(mesh, numbers);
  EXPECT_TRUE(example::same(with_positions<2>(mesh, numbers, positions), mesh));
  for (int n = 0; n < numbers.count; ++n) positions[n] = {{{1.0 * n, 0.5 * n}}};
  const MultiblockMesh<2> moved = with_positions<2>(mesh, numbers, positions);
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    for_each(numbers.zones[z].interior(), [&](const Index<2>& node) {
      EXPECT_EQ(moved.zones[z].nodes(node), positions[numbers.zones[z](node)]);
    });
  EXPECT_EQ(unique_positions(moved, numbers), positions);
}

TEST(NodeNumbers, RefusesPositionsOfAnotherMesh) {
  const MultiblockMesh<2> mesh = example::ring(12, 5), other = example::ring(12, 6);
  const NodeNumbers<2> numbers = number_nodes(mesh);
  EXPECT_THROW(with_positions<2>(mesh, numbers, unique_positions(other, number_nodes(other))), InternalError);
}

}  // namespace
}  // namespace wingbeat
