#include "optimize/requirement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test/core/mesh/message.hpp"

namespace wingbeat {
namespace {

using Relation = Requirement::Relation;
constexpr double infinity = std::numeric_limits<double>::infinity();

Requirement valid(const std::string& text) {
  const auto reading = read_requirement(text);
  for (const std::string& fault : reading.faults) ADD_FAILURE() << text << ": " << fault;
  EXPECT_EQ(reading.value.text, text);
  return reading.value;
}

void expect_reads(const std::string& text, const std::string& output, Relation relation, double number,
                  bool is_of_baseline, std::optional<double> scale = {}) {
  const Requirement r = valid(text);
  EXPECT_EQ(r.output, output) << text;
  EXPECT_EQ(r.relation, relation) << text;
  EXPECT_EQ(r.factor_or_value, number) << text;
  EXPECT_EQ(r.is_of_baseline, is_of_baseline) << text;
  EXPECT_EQ(r.scale, scale) << text;
}

TEST(Requirement, EveryFormOfABoundIsRead) {
  expect_reads("drag <= baseline", "drag", Relation::at_most, 1.0, true);
  expect_reads("lift>=0.98 baseline", "lift", Relation::at_least, 0.98, true);
  expect_reads(" thickness  >=  1.05*baseline ", "thickness", Relation::at_least, 1.05, true);
  expect_reads("moment = -2.5e-2", "moment", Relation::equal, -0.025, false);
  expect_reads("moment <= + .5", "moment", Relation::at_most, 0.5, false);
  expect_reads("moment >= -1 baseline", "moment", Relation::at_least, -1.0, true);
  expect_reads("onset_slope >= 0", "onset_slope", Relation::at_least, 0.0, false);
}

TEST(Requirement, AScaleIsReadAfterAnyBound) {
  expect_reads("drag <= baseline scale 0.05", "drag", Relation::at_most, 1.0, true, 0.05);
  expect_reads("drag <= 0.98 * baseline scale 1e-3", "drag", Relation::at_most, 0.98, true, 1e-3);
  expect_reads("moment = 0 scale 2", "moment", Relation::equal, 0.0, false, 2.0);
}

TEST(Requirement, AnUnknownOutputIsToldTheNearest) {
  const auto faults = read_requirement("leading_edge_radios >= baseline").faults;
  ASSERT_EQ(faults.size(), 1U);
  example::expect_contains(faults[0], "no output \"leading_edge_radios\"");
  example::expect_contains(faults[0], "the nearest is \"leading_edge_radius\"");
  example::expect_contains(faults[0], "outputs are drag, lift");
  EXPECT_EQ(read_requirement("qqqqqqqqqqqqqqqqq >= 1").faults.at(0).find("nearest"), std::string::npos);
}

TEST(Requirement, AllFaultsOfATextAreNamed) {
  const auto faults = read_requirement("drg => much scale -1").faults;
  ASSERT_EQ(faults.size(), 4U);
  example::expect_contains(faults[0], "no relation \"=>\"; allowed: \"<=\", \">=\", \"=\"");
  example::expect_contains(faults[1], "the nearest is \"drag\"");
  example::expect_contains(faults[2], "scale \"- 1\" is not a positive number");
  example::expect_contains(faults[3], "bound \"much\" cannot be read");
}

TEST(Requirement, TextsOfAnotherFormAreRefused) {
  for (const auto& [text, part] :
       std::vector<std::pair<std::string, std::string>>{{"", "no relation"},
                                                        {"drag", "no relation"},
                                                        {"0 <= drag <= 1", "2 relations"},
                                                        {"drag == 1", "no relation \"==\""},
                                                        {"drag < 1", "no relation \"<\""},
                                                        {"<= 1", "no output \"\""},
                                                        {"drag lift <= 1", "no output \"drag lift\""},
                                                        {"drag <=", "bound \"\""},
                                                        {"drag <= scale 1", "bound \"\""},
                                                        {"drag <= -", "bound \"-\""},
                                                        {"drag <= - baseline", "bound \"- baseline\""},
                                                        {"drag <= 2 * 3", "bound \"2 * 3\""},
                                                        {"drag <= 1 2", "bound \"1 2\""},
                                                        {"drag <= baseline 2", "bound \"baseline 2\""},
                                                        {"drag <= 2 lift", "bound \"2 lift\""},
                                                        {"drag <= 1e999", "cannot be read"},
                                                        {"drag <= nan", "bound \"nan\""},
                                                        {"drag <= 1 scale", "scale \"\""},
                                                        {"drag <= 1 scale 0", "scale \"0\""},
                                                        {"drag <= 1 scale 1 2", "scale \"1 2\""}}) {
    const auto faults = read_requirement(text).faults;
    ASSERT_EQ(faults.size(), 1U) << text;
    example::expect_contains(faults[0], part);
  }
}

TEST(Requirement, IntervalsAreOpenWhereThereIsNoBound) {
  const Interval below = interval(valid("drag <= 0.9 baseline"), 0.02);
  EXPECT_EQ(below.lower, -infinity);
  EXPECT_EQ(below.upper, 0.9 * 0.02);
  const Interval above = interval(valid("lift >= 0.3"), 0.02);
  EXPECT_EQ(above.lower, 0.3);
  EXPECT_EQ(above.upper, infinity);
  const Interval equal = interval(valid("moment = baseline"), -0.1);
  EXPECT_EQ(equal.lower, -0.1);
  EXPECT_EQ(equal.upper, -0.1);
}

TEST(Requirement, ViolationsAreMeasuredInTheFirstMeasureThereIs) {
  EXPECT_EQ(violation_scale(valid("drag <= 0.02 scale 0.5"), 0.01), 0.5);
  EXPECT_EQ(violation_scale(valid("moment >= -0.02"), 0.01), 0.02);
  EXPECT_EQ(violation_scale(valid("onset_slope >= 0"), -3.0), 3.0);
  EXPECT_EQ(violation_scale(valid("lift >= baseline"), 1e-9), 1.0) << "a lift of zero but for the residual";
}

TEST(Requirement, ThoseThatSayTheSameAreAlike) {
  EXPECT_TRUE(are_alike(valid("drag <= baseline"), valid("drag<=1 * baseline scale 0.1")));
  EXPECT_FALSE(are_alike(valid("drag <= baseline"), valid("drag <= 1")));
  EXPECT_FALSE(are_alike(valid("drag <= baseline"), valid("drag = baseline")));
  EXPECT_FALSE(are_alike(valid("drag <= baseline"), valid("lift <= baseline")));
  EXPECT_FALSE(are_alike(valid("drag <= 1"), valid("drag <= 2")));
}

TEST(Requirement, BoundsThatCrossAreNamedInPairs) {
  const std::vector<Requirement> list{valid("lift >= 0.5"), valid("lift <= 0.4"), valid("lift = 0.45"),
                                      valid("drag <= 0.1")};
  const auto faults = bounds_cross(list, {});
  ASSERT_EQ(faults.size(), 3U);
  example::expect_contains(faults[0], "\"lift >= 0.5\" and \"lift <= 0.4\"");
  example::expect_contains(faults[0], "no lift is both >= 0.5 and <= 0.4");
  example::expect_contains(faults[1], "\"lift >= 0.5\" and \"lift = 0.45\"");
  example::expect_contains(faults[2], "\"lift <= 0.4\" and \"lift = 0.45\"");
}

TEST(Requirement, BoundsOfTheBaselineCrossOnceItIsKnown) {
  const std::vector<Requirement> list{valid("lift >= baseline"), valid("lift <= 0.4")};
  EXPECT_TRUE(bounds_cross(list, {}).empty());
  EXPECT_TRUE(bounds_cross(list, {{"lift", 0.4}}).empty()) << "one value is left";
  EXPECT_EQ(bounds_cross(list, {{"lift", 0.41}}).size(), 1U);
  const std::vector<Requirement> negative{valid("moment <= baseline"), valid("moment >= 0.9 baseline")};
  EXPECT_TRUE(bounds_cross(negative, {{"moment", 1.0}}).empty());
  EXPECT_EQ(bounds_cross(negative, {{"moment", -1.0}}).size(), 1U) << "of a negative one, 0.9 is the larger";
}

}  // namespace
}  // namespace wingbeat
