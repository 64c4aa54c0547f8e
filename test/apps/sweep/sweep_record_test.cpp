#include "apps/sweep/sweep_record.hpp"

#include <gtest/gtest.h>

#include "apps/sweep/sweep_results.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

const SweepLine head{{"verb", "flutter"}, {"parameters", {"flow.mach"}}, {"case", {{"flow.gamma", "1.4"}}}};

SweepLine point(int number, double mach, const std::string& status) {
  return {{"point", number}, {"parameters", {{"flow.mach", mach}}}, {"status", status},
          {"reason", ""},    {"results", SweepLine::array()},       {"start", "none"},
          {"seconds", 1.5}};
}

std::string fault_of(const std::string& text) {
  try {
    read_sweep_lines(text, "sweep.jsonl", head);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(SweepRecord, TakesTheLaterOfTwoLinesAndLeavesOutOneCutShort) {
  const std::string text = head.dump() + "\n" + point(1, 0.7, "stalled").dump() + "\n" +
                           point(2, 0.8, "converged").dump() + "\n" + point(1, 0.7, "converged").dump() +
                           "\n";
  const std::string cut = point(3, 0.9, "converged").dump().substr(0, 20);
  const auto lines = read_sweep_lines(text + cut, "sweep.jsonl", head).ended;
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[1]["point"], 1);
  EXPECT_EQ(lines[1]["status"], "converged");
}

// So that the next run finds the folder of a point that was under way.
TEST(SweepRecord, KeepsPointsThatHaveBegunAndNotEnded) {
  std::string text = head.dump() + "\n";
  for (const auto& line : {point(1, 0.7, "begun"), point(2, 0.8, "begun"), point(1, 0.7, "converged")})
    text += line.dump() + "\n";
  const SweepLines lines = read_sweep_lines(text, "sweep.jsonl", head);
  ASSERT_EQ(lines.ended.size(), 1u);
  EXPECT_EQ(lines.ended[0]["status"], "converged");
  ASSERT_EQ(lines.begun.size(), 1u);
  EXPECT_EQ(line_of(lines.begun, {{"flow.mach", 0.8}})->at("point"), 2);
}

TEST(SweepRecord, RefusesAnotherCaseNamingItsKeysAndFilesThatAreNone) {
  SweepLine other = head;
  other["case"]["flow.gamma"] = "1.3";
  EXPECT_NE(fault_of(other.dump() + "\n").find("flow.gamma"), std::string::npos);
  other = head;
  other["verb"] = "lco";
  EXPECT_NE(fault_of(other.dump() + "\n").find("a sweep of \"lco\""), std::string::npos);
  EXPECT_NE(fault_of("{\"a\": 1}\n").find("not the record of a sweep"), std::string::npos);
  EXPECT_NE(fault_of("").find("empty"), std::string::npos);
  EXPECT_NE(fault_of("x\n" + head.dump() + "\n").find(":1: is not a line of JSON"), std::string::npos);
}

TEST(SweepTable, PutsParametersFirstThenSpeedFrequencyAndStatusAndSecondsLast) {
  SweepLine found = point(1, 0.8, "converged");
  found["results"] = {{{"speed_index", 0.7}, {"reduced_velocity", 3.0}, {"frequency_ratio", 0.8}},
                      {{"speed_index", 0.8}, {"reduced_velocity", 3.5}, {"frequency_ratio", 0.5}}};
  SweepLine failed = point(2, 0.7, "stalled");
  failed["reason"] = "no root";
  const CsvTable table = sweep_table({"flow.mach"}, {found, failed});
  EXPECT_EQ(
      table.text(),
      "flow.mach,reduced_velocity,frequency_ratio,status,speed_index,branch,reason,point,start,seconds\n"
      "0.7,,,stalled,,,no root,2,none,1.5\n"
      "0.8,3,0.8,converged,0.7,1,,1,none,1.5\n"
      "0.8,3.5,0.5,converged,0.8,2,,1,none,1.5\n");
}

TEST(SweepResults, AreFlatRowsOfWhatAVerbFound) {
  const nlohmann::ordered_json flutter = nlohmann::ordered_json::parse(
      R"({"flutter": {"reduced_velocity": 1}, "flutter_points": [{"reduced_velocity": 1, "residuals": {"flow": 2}},
          {"reduced_velocity": 3}]})");
  const auto rows = result_rows("flutter", flutter);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["residuals_flow"], 2);
  const auto pitch = result_rows(
      "pitch", nlohmann::ordered_json::parse(
                   R"({"pitch": {"reduced_frequency": 0.2, "harmonics": [{"n": 1, "cl": [1, 2], "cd": [3, 4],
                       "cm": [5, 6]}], "residual": 0}})"));
  EXPECT_EQ(pitch[0]["cm_1_im"], 6);
  EXPECT_TRUE(result_rows("lco", nlohmann::ordered_json::object()).empty());
}

}  // namespace
}  // namespace wingbeat
