#include <cmath>
#include <numbers>
#include <sstream>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

const std::string paper_section =
    "[mesh]\nairfoil = \"naca64a010\"\ncells = [48, 12]\n[structure]\nelastic_axis = -0.6\n"
    "static_unbalance = 0.25\ngyration_radius_squared = 0.75\nfrequency_ratio = 0.5\nmass_ratio = 75\n";
const std::string pitching = "[pitch]\namplitude_deg = 1.0\nreduced_frequency = 0.2\n";

// Each fault a user can make must end the program with status 2, a message that says what to do
// and a result.json that says the same.
class BadInput : public Program {
 protected:
  // Runs `verb` on a case with these lines of [mesh] and more.
  ProgramRun run_case(const std::string& verb, const std::string& text, int ranks = 0) const {
    write("case.toml", text);
    return run({verb, "case.toml", "--output", "out"}, ranks);
  }
};

// A ring of 16 x 4 cells in Plot3D, wall at radius 1 and far field at radius 30; node (i, j) moved by
// `shift`.
std::string ring_plot3d(int moved_i, int moved_j, double shift) {
  constexpr int around = 16, layers = 4;
  std::ostringstream x, y;
  for (int j = 0; j <= layers; ++j)
    for (int i = 0; i <= around; ++i) {
      // Clockwise from the inside, so that (i, j) is right-handed.
      const double angle = -2.0 * std::numbers::pi * (i % around) / around;
      const double radius =
          std::pow(30.0, static_cast<double>(j) / layers) + (i == moved_i && j == moved_j ? shift : 0.0);
      x << radius * std::cos(angle) << '\n';
      y << radius * std::sin(angle) << '\n';
    }
  return "1\n" + std::to_string(around + 1) + " " + std::to_string(layers + 1) + "\n" + x.str() + y.str();
}

TEST_F(BadInput, MisspeltKey) {
  expect_refused(run_case("mesh", "[mesh]\nairfoil = \"naca0012\"\n[flow]\nmahc = 0.8\n"), "out",
                 "case.toml:4: flow.mahc = 0.8: unknown key; did you mean flow.mach?");
}

TEST_F(BadInput, WrongType) {
  expect_refused(run_case("mesh", "[mesh]\nairfoil = \"naca0012\"\ncells = \"many\"\n"), "out",
                 "case.toml:3: mesh.cells = \"many\": expected two integers");
}

TEST_F(BadInput, OutOfRange) {
  expect_refused(run_case("mesh", "[mesh]\nairfoil = \"naca0012\"\n[flow]\nmach = 9.0\n"), "out",
                 "case.toml:4: flow.mach = 9.0: out of range; allowed: 0.05 to 3");
}

TEST_F(BadInput, AllFaultsAtOnceOnEveryRankOnce) {
  const auto run =
      run_case("mesh", "[mesh]\nairfoil = \"naca0012\"\nfile = \"none.cgns\"\n[flow]\nmach = nan\n", 2);
  expect_refused(run, "out", "2 faults in the case:");
  expect_in("mesh.file = \"none.cgns\": no such file", run.errors);
  expect_in("flow.mach = nan: not a finite number", run.errors);
  EXPECT_EQ(run.errors.find("2 faults"), run.errors.rfind("2 faults"));
}

TEST_F(BadInput, AirfoilAndFileExcludeEachOther) {
  write("mesh.cgns", "x");
  expect_refused(run_case("mesh", "[mesh]\nairfoil = \"naca0012\"\nfile = \"mesh.cgns\"\n"), "out",
                 "set together with mesh.file");
}

TEST_F(BadInput, NeitherAirfoilNorFile) {
  expect_refused(run_case("mesh", "[mesh]\ncells = [32, 8]\n"), "out", "give mesh.airfoil or mesh.file");
}

// What a run found is not taken for a later one's, nor lost where that is refused, however often.
TEST_F(BadInput, SetsTheResultOfTheRunBeforeAside) {
  const std::string good = "[mesh]\nairfoil = \"naca0012\"\ncells = [32, 8]\n";
  ASSERT_EQ(run_case("mesh", good).exit_code, 0);
  const std::string found = read("out/result.json"), log = read("out/log.txt"), done = read("out/case.toml");
  for (const std::string bad : {"[flow]\nmahc = 0.8\n", "airfoil = 3\n"}) {
    EXPECT_EQ(run_case("mesh", good + bad).exit_code, 2);
    EXPECT_EQ(result("out")["status"], "error");
    EXPECT_EQ(read("out/earlier/result.json"), found);
    EXPECT_EQ(read("out/earlier/log.txt"), log);
    EXPECT_EQ(read("out/earlier/case.toml"), done);
  }
  ASSERT_EQ(run({"mesh", "out/case.toml", "--output", "out"}).exit_code, 0) << "the case that lies there";
  EXPECT_EQ(result("out")["status"], "converged");
}

TEST_F(BadInput, EveryVerbChecksItsCaseFirst) {
  for (const std::string verb : {"steady", "pitch", "flutter", "lco", "pk", "mesh", "partition"})
    expect_refused(run_case(verb, "[mesh]\nairfoil = \"naca0012\"\n[flow]\nmahc = 0.8\n"), "out",
                   "case.toml:4: flow.mahc = 0.8: unknown key; did you mean flow.mach?");
}

TEST_F(BadInput, FlutterNamesEveryMissingKeyOfTheStructure) {
  const auto run = run_case("flutter", "[mesh]\nairfoil = \"naca0012\"\n[structure]\nmass_ratio = 75\n");
  expect_refused(run, "out", "4 faults in the case:");
  for (const std::string key :
       {"elastic_axis", "static_unbalance", "gyration_radius_squared", "frequency_ratio"})
    expect_in("structure." + key + ": missing; wingbeat flutter needs it", run.errors);
}

TEST_F(BadInput, PitchWithoutFrequencyOrMotionSaysBoth) {
  const auto run = run_case("pitch", "[mesh]\nairfoil = \"naca0012\"\n", 2);
  expect_refused(run, "out", "2 faults in the case:");
  expect_in("case.toml: pitch.reduced_frequency: missing; wingbeat pitch needs it", run.errors);
  expect_in("case.toml: pitch.amplitude_deg: the section does not move", run.errors);
}

TEST_F(BadInput, PitchAtNoFrequency) {
  expect_refused(
      run_case("pitch",
               "[mesh]\nairfoil = \"naca0012\"\n[pitch]\namplitude_deg = 1.0\nreduced_frequency = 0\n"),
      "out", "case.toml:5: pitch.reduced_frequency = 0: out of range; allowed: > 0");
}

TEST_F(BadInput, PitchBeyondTheHarmonicsKept) {
  const std::string motion =
      "[mesh]\nairfoil = \"naca0012\"\n[pitch]\nreduced_frequency = 0.2\nsine_deg = [1.0, 0.0, 0.5]\n";
  expect_refused(
      run_case("pitch", motion), "out",
      "pitch.sine_deg: moves harmonic 3, beyond time.harmonics = 1; set time.harmonics to 3 or more");
  EXPECT_EQ(run({"pitch", "case.toml", "--dry-run"}).exit_code, 2) << "a plan finds it, too";
  EXPECT_EQ(run({"pitch", "case.toml", "time.harmonics=3", "--dry-run"}).exit_code, 0);
  EXPECT_EQ(run({"pitch", "case.toml", "pitch.sine_deg=[1, 0, 0]", "--dry-run"}).exit_code, 0)
      << "zeros do not move";
}

TEST_F(BadInput, UnknownScheme) {
  expect_refused(run_case("steady", "[mesh]\nairfoil = \"naca0012\"\n[flow]\nscheme = \"rose\"\n"), "out",
                 "case.toml:4: flow.scheme = \"rose\": allowed: \"jst\", \"matrix\", \"cusp\", \"roe\", "
                 "\"van_leer\"; did you mean \"roe\"?");
}

TEST_F(BadInput, UnknownWaysOfSolving) {
  const auto run =
      run_case("flutter", paper_section + "[solver]\nmethod = \"stagered\"\nflow_method = \"rk\"\n");
  expect_refused(run, "out", "2 faults in the case:");
  expect_in("solver.method = \"stagered\": allowed: \"coupled\", \"staggered\"; did you mean \"staggered\"?",
            run.errors);
  expect_in("solver.flow_method = \"rk\": allowed: \"newton\", \"runge_kutta\", \"runge_kutta_newton\"",
            run.errors);
}

TEST_F(BadInput, CourantNumberOutOfRange) {
  for (const std::string cfl : {"0", "1e6"})
    expect_refused(run_case("steady", "[mesh]\nairfoil = \"naca0012\"\n[pseudo_time]\ncfl = " + cfl + "\n"),
                   "out", "case.toml:4: pseudo_time.cfl = ");
  expect_in("out of range; allowed: > 0, <= 100", result("out")["message"]);
}

// 250 x 50 cells are halved once, to 125 x 25: a third mesh has no half of 125.
TEST_F(BadInput, MoreMeshesThanTheCellsGive) {
  const std::string reason =
      "pseudo_time.levels = 4: the mesh gives 2 (halved once, zone \"block-1\" has 125 x 25 cells: 125 is "
      "odd); "
      "ask for fewer, or use cell counts divisible by 8";
  const std::string keys =
      "[pseudo_time]\nlevels = 4\n[mesh]\nairfoil = \"naca64a010\"\ncells = [250, 50]\n[solver]\n";
  expect_refused(run_case("steady", keys + "flow_method = \"runge_kutta\"\n", 2), "out",
                 "case.toml:2: " + reason);
  expect_refused(run_case("pitch", keys + "flow_method = \"runge_kutta\"\n" + pitching), "out",
                 "case.toml:2: " + reason);
}

TEST_F(BadInput, LimitCycleOfNoEnergyOrSpeed) {
  const std::string message =
      "lco.energies: no cycle is asked for; give this key (a list of E_0), lco.energy_range or "
      "lco.reduced_velocity";
  expect_refused(run_case("lco", paper_section, 2), "out", "case.toml: " + message);
  expect_refused(run_case("lco", paper_section + "[lco]\nenergies = []\n"), "out", message);
  expect_refused(run_case("lco", paper_section + "[lco]\nenergies = [1e-6, -1.0]\n"), "out",
                 "entry 2: out of range; allowed: > 0");
}

// The same keys of the undeformed section serve the other verbs, which need no motion.
TEST_F(BadInput, OtherVerbsNeedNoPrescribedMotion) {
  write("case.toml", "[mesh]\nairfoil = \"naca0012\"\ncells = [32, 8]\n[pitch]\nmean_deg = 1.0\n");
  EXPECT_EQ(run({"steady", "case.toml", "--dry-run"}).exit_code, 0);
}

TEST_F(BadInput, MissingCaseFile) {
  expect_refused(run({"mesh", "none.toml", "--output", "out"}), "out", "none.toml: cannot read the file");
}

TEST_F(BadInput, CaseThatIsNotToml) { expect_refused(run_case("mesh", "[mesh\n"), "out", "case.toml:1:"); }

TEST_F(BadInput, MissingMeshFile) {
  expect_refused(run_case("mesh", "[mesh]\nfile = \"none.cgns\"\n"), "out",
                 "case.toml:2: mesh.file = \"none.cgns\": no such file: ");
}

TEST_F(BadInput, CorruptCgns) {
  write("mesh.cgns", "this is not a mesh");
  expect_refused(run_case("mesh", "[mesh]\nfile = \"mesh.cgns\"\n"), "out", "mesh.cgns");
}

TEST_F(BadInput, TruncatedCgns) {
  write("good.toml", "[mesh]\nairfoil = \"naca0012\"\ncells = [32, 8]\n");
  ASSERT_EQ(run({"mesh", "good.toml"}).exit_code, 0);
  const std::string whole = read("good-mesh/mesh.cgns");
  write("mesh.cgns", whole.substr(0, whole.size() / 2));
  expect_refused(run_case("mesh", "[mesh]\nfile = \"mesh.cgns\"\n"), "out", "mesh.cgns");
}

TEST_F(BadInput, InvertedCellIsNamed) {
  write("ring.x", ring_plot3d(0, 0, 0.0));
  ASSERT_EQ(run_case("mesh", "[mesh]\nfile = \"ring.x\"\n").exit_code, 0) << read(".errors");
  std::filesystem::remove_all(folder_ / "out");
  write("ring.x", ring_plot3d(5, 1, 20.0));  // beyond the layers above it
  expect_refused(run_case("mesh", "[mesh]\nfile = \"ring.x\"\n"), "out", "volume");
}

TEST_F(BadInput, MoreRanksThanCells) {
  write("case.toml", "[mesh]\nairfoil = \"naca0012\"\ncells = [16, 4]\n");
  expect_refused(run({"partition", "case.toml", "--ranks", "65", "--output", "out"}), "out", "65 ranks");
}

// The largest mesh that the ranges allow, under a limit of what the program may ask for.
TEST_F(BadInput, MeshThatNoMemoryHolds) {
  write("limited", "#!/bin/sh\nulimit -v 4000000\nexec '" + program_ + "' \"$@\"\n");
  program_ = (folder_ / "limited").string();
  std::filesystem::permissions(program_, std::filesystem::perms::owner_all);
  const std::string message = "mesh.cells = [16384, 16384]: the mesh alone takes 20.1 GB on every rank, and ";
  expect_refused(run_case("mesh", "[mesh]\nairfoil = \"naca0012\"\ncells = [16384, 16384]\n"), "out",
                 message);
  EXPECT_EQ(run({"steady", "case.toml", "--dry-run"}).exit_code, 2) << "a plan finds it, too";
}

TEST_F(BadInput, OrdinatesThatAreNotNumbers) {
  write("wing.dat", "wing\n1.0 0.0\n0.5 0.05\n0.25 nan\n0.0 0.0\n0.5 -0.05\n1.0 0.0\n");
  expect_refused(run_case("mesh", "[mesh]\nairfoil = \"wing.dat\"\n"), "out", "wing.dat:4");
}

TEST_F(BadInput, UnknownAirfoilName) {
  expect_refused(run_case("mesh", "[mesh]\nairfoil = \"naca64a10\"\n"), "out", "not a known name");
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  write("case.toml", "[mesh]\nairfoil = \"naca0012\"\ncells = [32, 8]\n");
  write("plain", "a file where a folder should be");
  const auto refused = run({"mesh", "case.toml", "--output", "plain/out"}, 2);
  EXPECT_EQ(refused.exit_code, 2);
  expect_in("plain", refused.errors);
}

}  // namespace
}  // namespace wingbeat
