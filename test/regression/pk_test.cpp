#include <cmath>
#include <sstream>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

class Pk : public Program {
 protected:
  const std::string section_ = std::string(WINGBEAT_SOURCE_DIR) + "/apps/cases/naca64a010/case.toml";

  nlohmann::json pk(const std::string& file, std::vector<std::string> options, const std::string& output,
                    int ranks = 1) {
    std::vector<std::string> arguments{"pk", file, "--output", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun done = run(arguments, ranks);
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    printed_ = done.output;
    return result(output);
  }
  std::string printed_;
};

const std::vector<std::string> coarse{"mesh.cells=[64,16]", "pk.frequencies=12", "pk.samples=20"};

// Four ways to one point: Q is sampled where p-k crosses, so that nothing of the interpolation is left.
TEST_F(Pk, CrossesAtTheRootOfTheLinearizedProblem) {
  const auto found = pk(section_, coarse, "linearized", 2);
  const double root = found["linear_flutter"]["reduced_velocity"];
  const double omega = found["linear_flutter"]["frequency_ratio"];
  for (const char* method : {"pk", "g_method"}) {
    ASSERT_EQ(found[method]["crossings"].size(), 1u) << method;
    EXPECT_NEAR(found[method]["crossings"][0]["reduced_velocity"].get<double>() / root, 1.0, 1e-8) << method;
    EXPECT_NEAR(found[method]["crossings"][0]["frequency_ratio"].get<double>() / omega, 1.0, 1e-8) << method;
  }
  // The elastic axis lies ahead of where lift acts: no divergence.
  EXPECT_TRUE(found.contains("divergence"));
  EXPECT_TRUE(found["divergence"].is_null());
  expect_in("size and phase", printed_);

  // What was written is what the table route reads, without mesh or flow.
  write("table.toml",
        "[structure]\nelastic_axis = -0.6\nstatic_unbalance = 0.25\ngyration_radius_squared = 0.75\n"
        "frequency_ratio = 0.5\nmass_ratio = 75.0\n"
        "[pk]\naerodynamics = \"table\"\ntable_file = \"linearized/aerodynamic_matrix.csv\"\n");
  const auto again = pk("table.toml", {"pk.samples=20"}, "table", 2);
  EXPECT_NEAR(again["pk"]["crossings"][0]["reduced_velocity"].get<double>() / root, 1.0, 1e-8);
  EXPECT_NEAR(again["linear_flutter"]["reduced_velocity"].get<double>() / root, 1.0, 1e-8);
  EXPECT_FALSE(again.contains("divergence")) << "the table has no k = 0";
  EXPECT_EQ(read("linearized/pk.csv"), read("table/pk.csv"));
}

// Forced motion of amplitude a errs by a^2: half the amplitude, a quarter of the difference.
TEST_F(Pk, WithForcedMotionTendsToTheLinearizedPointWithTheSquareOfTheAmplitude) {
  const std::vector<std::string> few{"mesh.cells=[48,12]", "pk.frequencies=4", "pk.samples=20",
                                     "flutter.reduced_frequency_range=[0.06,0.2]",
                                     "pk.reduced_velocity_range=[2.0,4.0]"};
  const double root = pk(section_, few, "linearized")["pk"]["crossings"][0]["reduced_velocity"];
  const auto difference = [&](const std::string& degrees) {
    auto options = few;
    options.insert(options.end(), {"pk.aerodynamics=forced", "pitch.derivative_amplitude_deg=" + degrees,
                                   "time.harmonics=2"});
    const auto found = pk(section_, options, "forced-" + degrees);
    EXPECT_TRUE(files("forced-" + degrees).contains("aerodynamic_matrix_forced.csv"));
    EXPECT_TRUE(files("forced-" + degrees).contains("aerodynamic_matrix.csv"));
    return found["pk"]["crossings"][0]["reduced_velocity"].get<double>() - root;
  };
  const double large = difference("0.2"), small = difference("0.1");
  EXPECT_NEAR(std::log2(large / small), 2.0, 0.2);
  EXPECT_LT(std::abs(small), 1e-2 * root);
}

// Two uncoupled oscillators, the second without stiffness enough: K = c V^2 Q at V = sqrt(0.5/0.125) = 2.
TEST_F(Pk, OfAModalStructureFindsDivergence) {
  write("modal.toml",
        "[modal]\nmodes = [\"bending\", \"torsion\"]\nmass = [1, 0, 0, 2]\nstiffness = [0.25, 0, 0, 0.5]\n"
        "load_factor = 0.25\n[pk]\naerodynamics = \"table\"\ntable_file = \"q.csv\"\n");
  std::string table = "k,Q11_re,Q11_im,Q12_re,Q12_im,Q21_re,Q21_im,Q22_re,Q22_im\n";
  for (const char* k : {"0", "0.5", "1", "2"}) table += std::string(k) + ",-0.1,0,0,0,0,0,0.5,0\n";
  write("q.csv", table);
  const auto found = pk("modal.toml", {}, "modal", 2);
  EXPECT_NEAR(found["divergence"]["reduced_velocity"], 2.0, 1e-12);
  EXPECT_FALSE(found["divergence"].contains("speed_index"));
  EXPECT_TRUE(found["pk"]["crossings"].empty());
  expect_in("bending", read("modal/pk.csv"));
  expect_in("Q21_im", read("modal/aerodynamic_matrix.csv"));
}

TEST_F(Pk, SaysWhatATableNeeds) {
  const auto refuse = [&](const std::string& text, const std::string& message) {
    write("case.toml", text);
    expect_refused(run({"pk", "case.toml", "--output", "refused"}), "refused", message);
  };
  const std::string modal =
      "[modal]\nmodes = [\"a\", \"b\"]\nmass = [1, 0, 0, 1]\nstiffness = [1, 0, 0, 1]\nload_factor = 1.0\n";
  write("q.csv", "k,Q11_re,Q11_im\n");
  refuse("[pk]\naerodynamics = \"table\"\n", "give the table as pk.table_file");
  refuse(modal + "[pk]\naerodynamics = \"table\"\ntable_file = \"q.csv\"\n", "2 modes need 9");
  refuse(
      "[modal]\nmodes = [\"a\", \"b\"]\nmass = [1, 0]\nstiffness = [1, 0, 0, 1]\nload_factor = 1.0\n"
      "[pk]\naerodynamics = \"table\"\ntable_file = \"q.csv\"\n",
      "modal.mass");
  refuse(modal + "[pk]\naerodynamics = \"table\"\ntable_file = \"q.csv\"\n[structure]\nmass_ratio = 10.0\n",
         "[structure], too");
}

}  // namespace
}  // namespace wingbeat
