#include "optimize/objective_statement.hpp"

#include <gtest/gtest.h>

#include "optimize/output_names.hpp"
#include "test/core/mesh/message.hpp"

namespace wingbeat {
namespace {

using Terms = std::vector<std::pair<std::string, double>>;

void expect_reads(const std::string& text, bool is_maximized, const Terms& terms) {
  const auto reading = read_objective(text);
  for (const std::string& fault : reading.faults) ADD_FAILURE() << text << ": " << fault;
  EXPECT_EQ(reading.value.text, text);
  EXPECT_EQ(reading.value.is_maximized, is_maximized) << text;
  Terms found;
  for (const ObjectiveTerm& term : reading.value.terms) found.emplace_back(term.output, term.weight);
  EXPECT_EQ(found, terms) << text;
}

TEST(ObjectiveStatement, ANameAloneIsOptimisedInItsNaturalSense) {
  for (const OutputInfo& output : optimization_outputs()) {
    if (output.sense != NaturalSense::none) {
      expect_reads(output.name, output.sense == NaturalSense::maximize, {{output.name, 1.0}});
      continue;
    }
    const auto faults = read_objective(output.name).faults;
    ASSERT_EQ(faults.size(), 1U) << output.name;
    example::expect_contains(faults[0],
                             "write \"maximize " + output.name + "\" or \"minimize " + output.name);
  }
  expect_reads("  drag ", false, {{"drag", 1.0}});
}

TEST(ObjectiveStatement, SumsAreRead) {
  expect_reads("maximize flutter_speed", true, {{"flutter_speed", 1.0}});
  expect_reads("minimise moment", false, {{"moment", 1.0}});
  expect_reads("maximise flutter_speed - 1.1 drag", true, {{"flutter_speed", 1.0}, {"drag", -1.1}});
  expect_reads("minimize -2*lift+drag-.5 * area", false, {{"lift", -2.0}, {"drag", 1.0}, {"area", -0.5}});
  expect_reads("maximize + 1e-2 lift", true, {{"lift", 0.01}});
}

TEST(ObjectiveStatement, AllUnknownOutputsAreToldTheNearest) {
  const auto faults = read_objective("maximize fluter_speed - 2 drga").faults;
  ASSERT_EQ(faults.size(), 2U);
  example::expect_contains(faults[0], "the nearest is \"flutter_speed\"");
  example::expect_contains(faults[1], "the nearest is \"drag\"");
  example::expect_contains(read_objective("trag").faults.at(0), "the nearest is \"drag\"");
}

TEST(ObjectiveStatement, TextsOfAnotherFormAreRefused) {
  for (const auto& [text, part] : std::vector<std::pair<std::string, std::string>>{
           {"", "no output \"\""},
           {"maximize", "no output is named"},
           {"maximize drag +", "cannot be read at \"its end\""},
           {"maximize drag lift", "cannot be read at \"lift\""},
           {"maximize drag 2 lift", "cannot be read at \"lift\""},
           {"maximize 2", "cannot be read at \"its end\""},
           {"maximize 2 3 drag", "cannot be read at \"3\""},
           {"maximize drag - - lift", "cannot be read at \"-\""},
           {"maximize drag * 2", "cannot be read at \"*\""},
           {"maximize drag / lift", "cannot be read at \"/\""},
           {"drag - lift", "must begin with \"maximize\" or \"minimize\""},
           {"2 drag", "must begin with \"maximize\" or \"minimize\""},
           {"maximize drag + 0 lift", "\"lift\" has the weight 0"},
           {"maximize drag + lift - 2 drag", "\"drag\" stands twice"}}) {
    const auto faults = read_objective(text).faults;
    ASSERT_EQ(faults.size(), 1U) << text;
    example::expect_contains(faults[0], part);
  }
}

}  // namespace
}  // namespace wingbeat
