#include <gtest/gtest.h>

#include "core/mesh/find_interfaces.hpp"
#include "core/mesh/mesh_check.hpp"
#include "test/core/mesh/example_meshes.hpp"

namespace wingbeat {
namespace {

using namespace example;

// From every cell of the first block of a row, whatever the numbering of its neighbour, steps
// reach the cells they reach in the plain row, and lead back.
template <int Dim>
void expect_same_neighbours_for_all_orientations(const Index<Dim>& cells) {
  const MultiblockMesh<Dim> plain = row_of_blocks<Dim>(3, cells);
  for (const Orientation<Dim>& o : all_orientations<Dim>()) {
    const MultiblockMesh<Dim> turned = reoriented(plain, 1, o);
    for_each<Dim>(box_of<Dim>(cells), [&](const Index<Dim>& cell) {
      for (int d = 0; d < Dim; ++d)
        for (int step : {-1, 1}) {
          CellPosition<Dim> expected = start_position<Dim>(0, cell);
          CellPosition<Dim> position = expected;
          int steps = 0;
          while (step_to_neighbour(plain, expected, d, step)) {
            ASSERT_TRUE(step_to_neighbour(turned, position, d, step));
            ASSERT_EQ(position.zone, expected.zone);
            ASSERT_LT(distance<Dim>(centre<Dim>(plain, expected.zone, expected.cell),
                                    centre<Dim>(turned, position.zone, position.cell)),
                      1e-14 * 10);
            ++steps;
          }
          const CellPosition<Dim> last = position;
          ASSERT_FALSE(step_to_neighbour(turned, position, d, step));
          ASSERT_EQ(position.cell, last.cell);
          for (; steps > 0; --steps) ASSERT_TRUE(step_to_neighbour(turned, position, d, -step));
          const CellPosition<Dim> start = start_position<Dim>(0, cell);
          ASSERT_EQ(position.zone, start.zone);
          ASSERT_EQ(position.cell, start.cell);
          ASSERT_EQ(position.axis, start.axis);
          ASSERT_EQ(position.sign, start.sign);
        }
    });
  }
}

TEST(StepToNeighbour, ReachesTheSameCellsHoweverBlocksAreNumbered) {
  expect_same_neighbours_for_all_orientations<2>({3, 4});
  expect_same_neighbours_for_all_orientations<3>({2, 3, 4});
}

TEST(StepToNeighbour, WalksThroughBlocksOneCellThick) {
  expect_same_neighbours_for_all_orientations<2>({1, 2});
  expect_same_neighbours_for_all_orientations<3>({1, 1, 2});
}

TEST(StepToNeighbour, GoesRoundAnOMesh) {
  const MultiblockMesh<2> mesh = ring(8, 3);
  CellPosition<2> position = start_position<2>(0, {5, 1});
  for (int n = 1; n <= 8; ++n) {
    ASSERT_TRUE(step_to_neighbour(mesh, position, 0, 1));
    EXPECT_EQ(position.cell, (Index<2>{(5 + n) % 8, 1}));
  }
  EXPECT_EQ(position.sign, (Index<2>{1, 1}));
}

TEST(StepToNeighbour, TurnsRoundAcrossTheWakeOfACMesh) {
  const MultiblockMesh<2> mesh = guess_boundaries(find_interfaces(bare_c_mesh(), "c-mesh"), "c-mesh");
  CellPosition<2> position = start_position<2>(0, {1, 1});
  ASSERT_TRUE(step_to_neighbour(mesh, position, 1, -1));
  ASSERT_TRUE(step_to_neighbour(mesh, position, 1, -1));
  EXPECT_EQ(position.cell, (Index<2>{14, 0}));
  EXPECT_EQ(position.sign, (Index<2>{-1, -1}));
  ASSERT_TRUE(step_to_neighbour(mesh, position, 1, -1));
  EXPECT_EQ(position.cell, (Index<2>{14, 1}));
  ASSERT_TRUE(step_to_neighbour(mesh, position, 0, 1));
  EXPECT_EQ(position.cell, (Index<2>{13, 1}));
}

TEST(StepToNeighbour, StopsAtPhysicalBoundaries) {
  const MultiblockMesh<2> mesh = ring(8, 3);
  CellPosition<2> position = start_position<2>(0, {2, 0});
  EXPECT_FALSE(step_to_neighbour(mesh, position, 1, -1));
  EXPECT_EQ(position.cell, (Index<2>{2, 0}));
}

}  // namespace
}  // namespace wingbeat
