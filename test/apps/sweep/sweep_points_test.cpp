#include "apps/sweep/sweep_points.hpp"

#include <gtest/gtest.h>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

using Values = std::vector<std::string>;

std::string fault_of(const std::string& statement) {
  try {
    sweep_parameter(statement);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(SweepParameter, IsAListOfAnyTomlValues) {
  const SweepParameter mach = sweep_parameter("flow.mach = [0.7, 0.75]");
  EXPECT_EQ(mach.key, "flow.mach");
  EXPECT_EQ(mach.values, (Values{"0.7", "0.75"}));
  EXPECT_EQ(sweep_parameter("flow.scheme = [\"jst\", 'roe']").values.size(), 2u);
  EXPECT_EQ(sweep_parameter("mesh.cells = [[64, 16], [128, 32]]").values[1], "[ 128, 32 ]");
}

TEST(SweepParameter, IsARangeWithoutTheRoundOffOfItsSums) {
  const Values values = sweep_parameter("flow.mach = 0.7 to 0.9 step 0.01").values;
  ASSERT_EQ(values.size(), 21u);
  EXPECT_EQ(values[13], "0.83");
  EXPECT_EQ(values.back(), "0.9");
  EXPECT_EQ(sweep_parameter("flow.mach = 0.7 to 0.9 in 3").values, (Values{"0.7", "0.8", "0.9"}));
  EXPECT_EQ(sweep_parameter("flow.mach = 0.9 to 0.7 step -0.1").values, (Values{"0.9", "0.8", "0.7"}));
  EXPECT_EQ(sweep_parameter("time.harmonics = 1 to 3 step 1").values, (Values{"1", "2", "3"}));
  EXPECT_EQ(sweep_parameter("structure.mass_ratio = 50 to 60 in 3").values, (Values{"50", "55", "60"}));
  EXPECT_EQ(sweep_parameter("flow.mach = 0 to 1 in 3").values, (Values{"0.0", "0.5", "1.0"}));
}

TEST(SweepParameter, IsRefusedWithWhatIsWrong) {
  EXPECT_NE(fault_of("flow.mach").find("KEY = VALUES"), std::string::npos);
  EXPECT_NE(fault_of("mach = [0.7]").find("not a section.key"), std::string::npos);
  EXPECT_NE(fault_of("sweep.groups = [1, 2]").find("cannot change"), std::string::npos);
  EXPECT_NE(fault_of("flow.mach = []").find("empty"), std::string::npos);
  EXPECT_NE(fault_of("flow.mach = [0.7").find("not valid TOML"), std::string::npos);
  EXPECT_NE(fault_of("flow.mach = 0.7 to 0.9").find("step"), std::string::npos);
  EXPECT_NE(fault_of("flow.mach = 0.7 to 0.9 step -0.1").find("does not lead"), std::string::npos);
  EXPECT_NE(fault_of("flow.mach = 0.7 to x step 0.1").find("x is not a number"), std::string::npos);
  EXPECT_NE(fault_of("flow.mach = 0.7 to 0.9 in 1").find("2 or more"), std::string::npos);
  EXPECT_NE(fault_of("flow.mach = 0 to 1 step 1e-9").find("too many"), std::string::npos);
}

TEST(SweepPoints, AreAGridWithTheLastKeyFastestOrZipped) {
  const std::vector<SweepParameter> two{{"flow.mach", {"0.7", "0.8"}},
                                        {"structure.mass_ratio", {"50", "60"}}};
  const SweepPoints grid = grid_points(two), zipped = zipped_points(two);
  EXPECT_EQ(grid.values, (std::vector<Values>{{"0.7", "50"}, {"0.7", "60"}, {"0.8", "50"}, {"0.8", "60"}}));
  EXPECT_EQ(zipped.values, (std::vector<Values>{{"0.7", "50"}, {"0.8", "60"}}));
  const std::vector<SweepParameter> uneven{{"flow.mach", {"0.7"}}, {"structure.mass_ratio", {"50", "60"}}};
  EXPECT_THROW(zipped_points(uneven), InputError);
  const std::vector<SweepParameter> twice{{"flow.mach", {"0.7"}}, {"flow.mach", {"0.8"}}};
  EXPECT_THROW(grid_points(twice), InputError);
}

TEST(SweepPoints, AreReadFromATableWithFaultsByLine) {
  const SweepPoints points =
      tabled_points("# a\nflow.mach, structure.mass_ratio\n0.7, 50\n\n0.8,60\n", "t.csv");
  EXPECT_EQ(points.keys, (Values{"flow.mach", "structure.mass_ratio"}));
  EXPECT_EQ(points.values, (std::vector<Values>{{"0.7", "50"}, {"0.8", "60"}}));
  try {
    tabled_points("flow.mach,structure.mass_ratio\n0.7,50\n0.8\n", "t.csv");
    FAIL() << "a line is short of a value";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("t.csv:3: 1 values for 2 keys"), std::string::npos)
        << error.what();
  }
  EXPECT_THROW(tabled_points("flow.mach\n", "t.csv"), InputError);
}

TEST(SweepPoints, HavePlacesThatSpanOneUnitByNumberAndAreAllApartByText) {
  const SweepPoints points{{"flow.mach", "flow.scheme"}, {{"0.7", "jst"}, {"0.75", "jst"}, {"0.9", "roe"}}};
  const auto places = point_places(points);
  EXPECT_EQ(places[0], (std::vector<double>{0.0, 1.0, 0.0}));
  EXPECT_NEAR(places[1][0], 0.25, 1e-15);
  EXPECT_EQ(places[2], (std::vector<double>{1.0, 0.0, 1.0}));
}

}  // namespace
}  // namespace wingbeat
