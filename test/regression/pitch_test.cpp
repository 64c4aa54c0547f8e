#include <cmath>
#include <complex>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

// What ADflow 2.13.1 gave for case CT6 (NACA 64A010, Mach 0.796, 1.01 deg sin about the quarter chord,
// k = 0.202): time-spectral, cell-centred, scalar JST with classical switches, its two-dimensional limit;
// C(t) = mean + S sin + C cos; computed for this comparison.
struct Peer {
  double lift_sine, lift_cosine, moment_sine, moment_cosine, mean_drag;

  Complex lift() const { return {lift_cosine, -lift_sine}; }
  Complex moment() const { return {moment_cosine, -moment_sine}; }
};
const Peer three_instances{0.098031, -0.038824, -0.010106, -0.008292, 0.0019101};  // 128 x 32
const Peer five_instances{0.098038, -0.038650, -0.009707, -0.008355, 0.0019080};   // 128 x 32

class ForcedPitch : public Program {
 protected:
  nlohmann::json pitch(std::vector<std::string> options, int ranks = 2) {
    std::vector<std::string> arguments{
        "pitch", std::string(WINGBEAT_SOURCE_DIR) + "/apps/cases/agard-ct6/case.toml", "--output", "out"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun done = run(arguments, ranks);
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    return result("out")["pitch"];
  }
};

Complex harmonic(const nlohmann::json& pitch, std::size_t n, const char* load) {
  const auto& value = pitch["harmonics"][n][load];
  return {value[0], value[1]};
}

// First harmonics as complex numbers: the modulus of the difference over that of the peer's.
void expect_near_peer(const nlohmann::json& pitch, const Peer& peer, double lift, double moment) {
  EXPECT_LE(std::abs(harmonic(pitch, 1, "cl") - peer.lift()), lift * std::abs(peer.lift()));
  EXPECT_LE(std::abs(harmonic(pitch, 1, "cm") - peer.moment()), moment * std::abs(peer.moment()));
  EXPECT_LE(pitch["residual"], 1e-10);
}

TEST_F(ForcedPitch, FirstHarmonicsOfCt6AreThoseOfAnIndependentCode) {
  const auto classical = pitch({"flow.jst_smoothing=0"});
  expect_near_peer(classical, three_instances, 0.01, 0.03);
  EXPECT_NEAR(harmonic(classical, 0, "cd").real(), three_instances.mean_drag,
              0.02 * three_instances.mean_drag);
  expect_near_peer(pitch({}), three_instances, 0.01, 0.03);
  expect_near_peer(pitch({"time.harmonics=2"}), five_instances, 0.01, 0.03);
}

TEST_F(ForcedPitch, RestartsFromItsSolution) {
  const std::vector<std::string> coarse{"mesh.cells=[64,16]"};
  const auto first = pitch(coarse, 1);
  const auto again = pitch({coarse[0], "--restart", "out/solution.cgns"});
  EXPECT_EQ(again["iterations"], 0);
  for (const char* load : {"cl", "cd", "cm"})
    EXPECT_LE(std::abs(harmonic(first, 1, load) - harmonic(again, 1, load)), 1e-8) << load;
}

// The moment about another point of the section follows from the loads at every instant.
TEST_F(ForcedPitch, MomentReferenceMovesWithTheSection) {
  const auto quarter = pitch({"mesh.cells=[64,16]"}, 1);
  const auto nose = pitch({"mesh.cells=[64,16]", "flow.moment_reference=[0.0, 0.0]"}, 1);
  for (std::size_t n = 0; n < 3; ++n) {
    const auto& q = quarter["instances"][n];
    const double alpha = 1.01 * M_PI / 180.0 * std::sin(q["phase"].get<double>());
    const double normal = q["cl"].get<double>() * std::cos(alpha) + q["cd"].get<double>() * std::sin(alpha);
    EXPECT_NEAR(nose["instances"][n]["cm"], q["cm"].get<double>() - 0.25 * normal, 1e-9);
  }
}

TEST_F(ForcedPitch, DerivativesOfSmallMotionAreTheLinearizedOnes) {
  const auto derivatives = pitch(
      {"mesh.cells=[64,16]", "pitch.derivatives=true", "pitch.derivative_amplitude_deg=0.01"})["derivatives"];
  EXPECT_LE(derivatives["difference"], 1e-4);
  for (const char* entry : {"Qhh", "Qha", "Qah", "Qaa"})
    for (std::size_t part : {0, 1})
      EXPECT_NEAR(derivatives["forced"][entry][part], derivatives["linearized"][entry][part], 1e-3) << entry;
  EXPECT_TRUE(files("out").contains("derivatives.csv"));
}

}  // namespace
}  // namespace wingbeat
