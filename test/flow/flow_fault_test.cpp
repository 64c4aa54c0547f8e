#include "flow/flow_fault.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "test/flow/flow_case.hpp"

namespace wingbeat {
namespace {

using testing::bent_box;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int instances = 3;
constexpr std::size_t n = 4;

// Two blocks of 12 x 16 cells of a unit square, and uniform flow in three instances of them.
class BrokenFlow : public ::testing::Test {
 protected:
  BrokenFlow()
      : level_(Comm(), cut_blocks(bent_box<2>({24, 16}, 0.0), 2), {{1.4, 0.8}, JstScheme{}}, {}, {}) {
    const std::vector<double> uniform = level_.steady.uniform_state();
    for (int i = 0; i < instances; ++i) w_.insert(w_.end(), uniform.begin(), uniform.end());
    r_.assign(w_.size(), 0.0);
  }

  // Sets one number of a cell of the second block in some instance, on the rank that has it.
  void plant(std::vector<double>& field, int instance, int i, int j, int variable, double value) {
    const long cell = 12 * 16 + 12 * j + i;
    for (std::size_t c = 0; c < level_.local.global_cell.size(); ++c)
      if (level_.local.global_cell[c] == cell)
        field[static_cast<std::size_t>(instance) * level_.domain.state_count() + n * c +
              static_cast<std::size_t>(variable)] = value;
  }

  FlowLevel<2> level_;
  std::vector<double> w_, r_;
};

TEST_F(BrokenFlow, IsNotSeenInAWholeOne) { EXPECT_EQ(describe_fault<2>(level_, w_, r_), ""); }

TEST_F(BrokenFlow, IsToldByInstanceBlockCellAndPlace) {
  const std::string where = "instance 2 of 3, block \"box-2\", cell (3, 6) at x = 0.604167, y = 0.34375: ";
  plant(w_, 1, 2, 5, 0, -0.5);
  EXPECT_EQ(describe_fault<2>(level_, w_).substr(0, where.size() + 12), where + "density -0.5");
  for (const double value : {nan, infinity, 0.0}) {
    plant(w_, 1, 2, 5, 0, value);
    EXPECT_EQ(describe_fault<2>(level_, w_).find(where), 0U) << value;
  }
  plant(w_, 1, 2, 5, 0, 1.0);
  ASSERT_EQ(describe_fault<2>(level_, w_), "");
  for (const double energy : {nan, infinity, 0.0}) {
    plant(w_, 1, 2, 5, 3, energy);
    EXPECT_EQ(describe_fault<2>(level_, w_).find(where + "density 1, pressure "), 0U) << energy;
  }
}

TEST_F(BrokenFlow, IsToldOfAResidualWhereTheStateIsWell) {
  plant(r_, 2, 11, 15, 1, nan);
  EXPECT_EQ(
      describe_fault<2>(level_, w_, r_),
      "instance 3 of 3, block \"box-2\", cell (12, 16) at x = 0.979167, y = 0.96875: density 1, pressure 1, "
      "a residual that is not finite");
}

TEST_F(BrokenFlow, IsToldOfAWholeMeshAsAFileHasIt) {
  std::vector<double> whole;
  const State<2, double> state = level_.steady.model().freestream.state();
  for (std::size_t i = 0; i < 2 * level_.mesh.cell_count() * n; ++i)
    whole.push_back(state[static_cast<int>(i % n)]);
  EXPECT_EQ(describe_fault<2>(level_.mesh, whole, 1.4), "");
  whole[(level_.mesh.cell_count() + 12) * n + 3] = -1.0;
  EXPECT_EQ(
      describe_fault<2>(level_.mesh, whole, 1.4).find("instance 2 of 2, block \"box-1\", cell (1, 2) at "),
      0U);
}

}  // namespace
}  // namespace wingbeat
