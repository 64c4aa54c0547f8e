#include <cmath>
#include <sstream>

#include "test/apps/program.hpp"
#include "test/nightly.hpp"

namespace wingbeat {
namespace {

// What a run found, without what it took.
nlohmann::json findings_of(nlohmann::json result) {
  for (const char* cost : {"wall_seconds", "memory"}) result.erase(cost);
  return result;
}

class RepeatedRun : public Program {
 protected:
  // Rows of history.csv without their last column, the seconds.
  std::vector<std::string> history() const {
    std::istringstream in(read("out/history.csv"));
    std::vector<std::string> rows;
    for (std::string row; std::getline(in, row);) rows.push_back(row.substr(0, row.rfind(',')));
    return rows;
  }
  // A number that differs in its last bit is written differently.
  nlohmann::json run_flutter() const {
    const auto done = run({"flutter", "case.toml", "--output", "out"}, 2);
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    return findings_of(result("out"));
  }
};

TEST_F(RepeatedRun, FindsTheSameBitForBit) {
  write("case.toml",
        "[mesh]\nairfoil = \"naca64a010\"\ncells = [48, 12]\n[flow]\nmach = 0.8\n[structure]\nelastic_axis = "
        "-0.6\n"
        "static_unbalance = 0.25\ngyration_radius_squared = 0.75\nfrequency_ratio = 0.5\nmass_ratio = 75\n");
  const nlohmann::json first = run_flutter();
  const std::vector<std::string> iterations = history();
  const std::string surface = read("out/surface.csv");
  ASSERT_TRUE(first.contains("flutter"));
  const int repeats = testing::is_nightly() ? 9 : 2;
  for (int i = 0; i < repeats; ++i) {
    EXPECT_EQ(run_flutter(), first);
    EXPECT_EQ(history(), iterations);
    EXPECT_TRUE(read("out/surface.csv") == surface);
  }
}

TEST_F(RepeatedRun, IsToldFromOneWithAnotherLastBit) {
  nlohmann::json one = {{"wall_seconds", {{"total", 1.0}}}, {"flutter", {{"reduced_velocity", 2.8}}}};
  nlohmann::json other = one;
  other["wall_seconds"]["total"] = 2.0;
  EXPECT_EQ(findings_of(other), findings_of(one));
  other["flutter"]["reduced_velocity"] = std::nextafter(2.8, 3.0);
  EXPECT_NE(findings_of(nlohmann::json::parse(other.dump())), findings_of(nlohmann::json::parse(one.dump())));
}

}  // namespace
}  // namespace wingbeat
