#include "optimize/problem_statement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/io/case_file.hpp"
#include "optimize/named_problems.hpp"
#include "optimize/output_names.hpp"
#include "test/core/mesh/message.hpp"

namespace wingbeat {
namespace {

OptimizeSettings read(const std::string& text) {
  OptimizeSettings optimize;
  SettingRegistry registry;
  registry.add_section("optimize", "", optimize);
  CaseFile("[optimize]\n" + text, "case.toml")
      .apply(
          registry, [] { return std::vector<std::string>{}; }, "a test");
  return optimize;
}

std::vector<std::string> faults_of(const std::string& text) { return statement_faults(read(text)); }

TEST(OptimizeSettings, DefaultsAreAValidStatement) {
  const OptimizeSettings optimize = read("");
  EXPECT_TRUE(statement_faults(optimize).empty());
  EXPECT_EQ(optimize.variables, std::vector<std::string>{"bumps"});
  EXPECT_EQ(optimize.compare, (std::vector<std::string>{"steady", "flutter"}));
  const ProblemStatement statement = problem_statement(optimize);
  EXPECT_EQ(statement.outputs(), std::vector<std::string>{"flutter_speed"});
  EXPECT_TRUE(statement.objective.is_maximized);
  EXPECT_TRUE(statement.requirements.empty());
}

TEST(OptimizeSettings, ReadsEveryKey) {
  const OptimizeSettings o = read(
      "problem = \"flutter-drag\"\nobjective = \"drag\"\nconstraints = [\"lift >= 0\"]\nmonitor = "
      "[\"area\"]\nvariables = [\"bumps\", \"angle_of_attack\"]\nangle_bound_deg = 1.5\nstart = [0.001, "
      "0.1]\nmax_iterations = 7\ntolerance = 1e-5\nipopt = [\"mu_strategy = adaptive\"]\ngroups = 2\n"
      "sharpness = 50.0\ncompare = [\"pk\"]\nroot_margin = 0.1\nmax_bisections = 3\n");
  EXPECT_EQ(o.problem, "flutter-drag");
  EXPECT_EQ(o.objective, "drag");
  EXPECT_EQ(o.constraints, std::vector<std::string>{"lift >= 0"});
  EXPECT_EQ(o.monitor, std::vector<std::string>{"area"});
  EXPECT_EQ(o.variables, (std::vector<std::string>{"bumps", "angle_of_attack"}));
  EXPECT_EQ(o.angle_bound_deg, 1.5);
  EXPECT_EQ(o.start, (std::vector<double>{0.001, 0.1}));
  EXPECT_EQ(o.max_iterations, 7);
  EXPECT_EQ(o.tolerance, 1e-5);
  EXPECT_EQ(o.ipopt.size(), 1U);
  EXPECT_EQ(o.groups, 2);
  EXPECT_EQ(o.sharpness, 50.0);
  EXPECT_EQ(o.compare, std::vector<std::string>{"pk"});
  EXPECT_EQ(o.root_margin, 0.1);
  EXPECT_EQ(o.max_bisections, 3);
}

TEST(OptimizeSettings, RefusesValuesOutOfRange) {
  for (const auto& [text, part] :
       std::vector<std::pair<std::string, std::string>>{{"problem = \"fluter\"", "\"flutter\""},
                                                        {"monitor = [\"drga\"]", "\"drag\""},
                                                        {"variables = [\"bump\"]", "\"bumps\""},
                                                        {"angle_bound_deg = 0.0", "optimize.angle_bound_deg"},
                                                        {"max_iterations = -1", "optimize.max_iterations"},
                                                        {"tolerance = 1.0", "optimize.tolerance"},
                                                        {"groups = 0", "optimize.groups"},
                                                        {"sharpness = 0.0", "optimize.sharpness"},
                                                        {"compare = [\"march\"]", "optimize.compare"},
                                                        {"root_margin = 0.6", "optimize.root_margin"},
                                                        {"max_bisections = -1", "optimize.max_bisections"}})
    example::expect_contains(example::message_of([&, &text = text] { read(text); }), part);
}

TEST(NamedProblems, AllAreValidStatementsOfOutputsThatExist) {
  std::set<std::string> names;
  for (const NamedProblem& problem : named_problems()) {
    EXPECT_TRUE(names.insert(problem.name).second) << problem.name << " stands twice";
    EXPECT_EQ(find_problem(problem.name), &problem);
    const OptimizeSettings settings = read("problem = \"" + problem.name + "\"");
    for (const std::string& fault : statement_faults(settings))
      ADD_FAILURE() << problem.name << ": " << fault;
    const ProblemStatement statement = problem_statement(settings);
    EXPECT_EQ(statement.objective.text, problem.objective);
    ASSERT_EQ(statement.requirements.size(), problem.constraints.size());
    for (std::size_t i = 0; i < problem.constraints.size(); ++i)
      EXPECT_EQ(statement.requirements[i].text, problem.constraints[i]);
    for (const std::string& output : statement.outputs()) EXPECT_NE(find_output(output), nullptr) << output;
  }
  EXPECT_EQ(problem_names().size(), names.size());
  EXPECT_EQ(find_problem("Flutter"), nullptr);
  EXPECT_EQ(find_problem(""), nullptr);
}

TEST(ProblemStatement, ConstraintsAddToThoseOfTheNamedProblem) {
  const ProblemStatement statement = problem_statement(
      read("problem = \"flutter-drag-lift\"\nconstraints = [\"area >= baseline\", \"lift <= 2 baseline\"]"));
  ASSERT_EQ(statement.requirements.size(), 4U);
  EXPECT_EQ(statement.requirements[0].text, "drag <= baseline");
  EXPECT_EQ(statement.requirements[2].text, "area >= baseline");
  EXPECT_EQ(statement.outputs(), (std::vector<std::string>{"flutter_speed", "drag", "lift", "area"}))
      << "each once, those of the objective first";
}

TEST(ProblemStatement, AllFaultsAreNamedWithTheirKeysAtOnce) {
  const auto faults = faults_of(
      "objective = \"maximize fluter_speed\"\n"
      "constraints = [\"darg <= baseline\", \"lift >= 0.5\", \"lift <= 0.4\", \"area >= much\", \"area = "
      "1\", "
      "\"area = 2\", \"lift >= 0.50\"]\n"
      "variables = []\n");
  const std::vector<std::string> parts{
      "optimize.objective = \"maximize fluter_speed\": no output \"fluter_speed\"; the nearest is "
      "\"flutter_speed\"",
      "optimize.constraints = \"darg <= baseline\": no output \"darg\"; the nearest is \"drag\"",
      "optimize.constraints = \"area >= much\": bound \"much\"",
      "optimize.constraints = \"area = 2\": area is to equal another bound as well, \"area = 1\"",
      "optimize.constraints = \"lift >= 0.50\": repeats \"lift >= 0.5\"; leave it out",
      "optimize.constraints: \"lift >= 0.5\" and \"lift <= 0.4\": no lift",
      "optimize.constraints: \"lift <= 0.4\" and \"lift >= 0.50\": no lift",
      "optimize.variables = []: nothing to vary"};
  ASSERT_EQ(faults.size(), parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) example::expect_contains(faults[i], parts[i]);
}

TEST(ProblemStatement, FaultsOfTheNamedProblemAreNamed) {
  OptimizeSettings unknown;
  unknown.problem = "flutter-darg";
  const auto faults = statement_faults(unknown);
  ASSERT_EQ(faults.size(), 1U);
  example::expect_contains(faults[0],
                           "the nearest is \"flutter-drag\"; problems are flutter, flutter-drag, ");

  const auto both = faults_of("problem = \"flutter\"\nobjective = \"drag\"");
  ASSERT_EQ(both.size(), 1U);
  example::expect_contains(both[0], "optimize.objective = \"drag\" is given too; leave one of them out");

  const auto repeated = faults_of("problem = \"flutter-drag\"\nconstraints = [\"drag <= 1 baseline\"]");
  ASSERT_EQ(repeated.size(), 1U);
  example::expect_contains(repeated[0], "repeats \"drag <= baseline\" of optimize.problem; leave it out");
}

TEST(ProblemStatement, TheErrorHasALineForEveryFault) {
  const std::string message = example::message_of(
      [] { problem_statement(read("objective = \"darg\"\nconstraints = [\"lift >= \", \"lfit >= 1\"]")); });
  EXPECT_EQ(std::ranges::count(message, '\n'), 2);
  for (const char* part : {"\"darg\"", "bound \"\"", "the nearest is \"lift\""})
    example::expect_contains(message, part);
}

}  // namespace
}  // namespace wingbeat
