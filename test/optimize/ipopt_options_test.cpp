#include "optimize/ipopt_options.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/io/error.hpp"
#include "test/optimize/toy_programs.hpp"

namespace wingbeat {
namespace {

// The only sentence about one option; empty for none.
std::string fault_of(const std::string& extra) {
  const auto faults = ipopt_option_faults(std::vector<std::string>{extra});
  EXPECT_LE(faults.size(), 1U);
  return faults.empty() ? std::string() : faults.front();
}

TEST(IpoptOptions, ValidOnesAreNoFault) {
  for (const char* extra : {"max_soc=0", "  mu_strategy  =  monotone ", "constr_viol_tol = 1e-6",
                            "acceptable_iter = 5", "limited_memory_max_history = 12",
                            "hessian_approximation = limited-memory", "nlp_scaling_method = none"})
    EXPECT_EQ(fault_of(extra), "") << extra;
}

TEST(IpoptOptions, AnUnknownNameIsToldTheNearest) {
  EXPECT_EQ(fault_of("mu_stratgy = adaptive"),
            "mu_stratgy = adaptive: Ipopt has no such option; did you mean mu_strategy?");
  EXPECT_EQ(fault_of("qwertyuiop = 1"),
            "qwertyuiop = 1: Ipopt has no such option; see the list of options in its manual");
}

TEST(IpoptOptions, AWrongTypeIsToldTheRightOne) {
  EXPECT_EQ(fault_of("max_soc = many"), "max_soc = many: expected an integer: >= 0");
  EXPECT_EQ(fault_of("max_soc = 2.5"), "max_soc = 2.5: expected an integer: >= 0");
  EXPECT_EQ(fault_of("mu_init = small"), "mu_init = small: expected a number: > 0");
  EXPECT_EQ(fault_of("mu_init = nan"), "mu_init = nan: expected a number: > 0");
}

TEST(IpoptOptions, AValueOutOfRangeIsToldTheRange) {
  EXPECT_EQ(fault_of("mu_init = 0"), "mu_init = 0: out of range; allowed: > 0");
  EXPECT_EQ(fault_of("print_level = 13"), "print_level = 13: out of range; allowed: 0 to 12");
  EXPECT_EQ(fault_of("mu_strategy = adaptve"),
            "mu_strategy = adaptve: allowed: monotone, adaptive; did you mean adaptive?");
}

TEST(IpoptOptions, OnesOfTheCaseNameItsKey) {
  EXPECT_EQ(fault_of("tol = 1e-6"), "tol = 1e-6: follows optimize.tolerance; set that key instead");
  EXPECT_EQ(fault_of("max_iter = 7"), "max_iter = 7: follows optimize.max_iterations; set that key instead");
  EXPECT_EQ(fault_of("hessian_approximation = exact"),
            "hessian_approximation = exact: second derivatives are not available; leave it out");
  EXPECT_NE(fault_of("nlp_scaling_method = gradient-based"), "");
  EXPECT_NE(fault_of("output_file = ipopt.out"), "");
}

TEST(IpoptOptions, TextsThatAreNoAssignmentAreShownOne) {
  for (const char* extra : {"max_soc 4", "max_soc =", "= 4", ""})
    EXPECT_EQ(fault_of(extra), fmt::format("\"{}\": expected name = value, as in max_soc = 4", extra));
}

TEST(IpoptOptions, EveryFaultIsReportedAndRepetitionIsOne) {
  const std::vector<std::string> extra{"max_soc = 4", "max_soc = 5", "tol = 1", "nothing"};
  EXPECT_EQ(ipopt_option_faults(extra).size(), 3U);
}

TEST(IpoptOptions, OwnOnesAreKnownToIpoptAndOthersOverrideThem) {
  ToyProgram program = hock_schittkowski_71(), adaptive = hock_schittkowski_71();
  EXPECT_EQ(minimize(program, {.extra = {"mu_strategy = monotone"}}).status, OptimizerStatus::converged);
  minimize(adaptive);
  EXPECT_NE(program.asked, adaptive.asked);
}

TEST(IpoptOptions, ARunRefusesFaults) {
  ToyProgram program = hock_schittkowski_71();
  EXPECT_THROW(minimize(program, {.extra = {"mu_stratgy = adaptive"}}), InputError);
  EXPECT_TRUE(program.asked.empty());
}

TEST(IpoptOptions, ALinearSolverThatIsNotInstalledIsTheCasesFault) {
  ToyProgram program = hock_schittkowski_71();
  EXPECT_THROW(minimize(program, {.extra = {"linear_solver = wsmp"}}), InputError);
}

TEST(IpoptOptions, AreNamesWithValues) {
  const auto spaced = parse_assignment(" mu_init =  1e-2 "), twice = parse_assignment("a = b = c");
  ASSERT_TRUE(spaced && twice);
  EXPECT_EQ(spaced->name, "mu_init");
  EXPECT_EQ(spaced->value, "1e-2");
  EXPECT_EQ(twice->name, "a");
  EXPECT_EQ(twice->value, "b = c");
  for (const char* text : {"", "mu_init", "mu_init =", "= 1", " = "})
    EXPECT_FALSE(parse_assignment(text)) << text;
}

}  // namespace
}  // namespace wingbeat
