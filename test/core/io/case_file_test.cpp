#include "core/io/case_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/io/error.hpp"
#include "core/io/setting_text.hpp"

namespace wingbeat {
namespace {

struct WingSettings {
  double mach = 0.8;
  double gamma = 1.4;
  int blocks = 1;
  bool moving = false;
  std::string scheme = "jst";
  std::array<int, 2> cells{250, 50};
  std::vector<double> speeds{};
  std::optional<std::array<double, 2>> axis{};
  std::optional<std::string> file{};

  void describe(SettingSection& keys) {
    keys.add("mach", &mach, {.help = "Mach number", .range = between(0.05, 3)});
    keys.add("gamma", &gamma, {.help = "ratio of specific heats", .range = above(1)});
    keys.add("blocks", &blocks, {.help = "blocks", .range = between(1, 64)});
    keys.add("moving", &moving, {.help = "whether it moves"});
    keys.add("scheme", &scheme, {.help = "scheme", .allowed = {"jst", "roe"}});
    keys.add("cells", &cells, {.help = "cells", .range = at_least(4)});
    keys.add("speeds", &speeds, {.help = "speeds", .unit = "m/s", .range = above(0)});
    keys.add("axis", &axis, {.help = "axis", .unit = "chords"});
    keys.add("file", &file, {.help = "file", .path = PathRule::file});
    keys.add_rule(
        "blocks", [this] { return blocks <= cells[0]; }, "more blocks than cells around");
  }
};

struct MassSettings {
  double mass_ratio = 0.0;
  double other_ratio = 2.0;

  void describe(SettingSection& keys) {
    keys.add("mass_ratio", &mass_ratio, {.help = "mass ratio", .range = above(0), .required = true});
    keys.add("other_ratio", &other_ratio, {.help = "another ratio", .range = above(0)});
  }
};

// A case applied to both structs; the message of the InputError, or empty.
struct Outcome {
  WingSettings wing;
  MassSettings mass;
  std::string message;
  std::string resolved;
};

Outcome apply(const std::string& text, const std::vector<std::string>& overrides = {},
              const std::vector<std::string>& used = {"wing"}, const std::string& name = "case.toml") {
  Outcome outcome;
  SettingRegistry registry;
  registry.add_section("wing", "The wing.", outcome.wing);
  registry.add_section("mass", "The mass.", outcome.mass);
  try {
    CaseFile file(text, name);
    for (const auto& assignment : overrides) file.add_override(assignment);
    file.apply(registry, used, "wingbeat fly");
    outcome.resolved = resolved_case(registry);
  } catch (const InputError& error) {
    outcome.message = error.what();
  }
  return outcome;
}

void expect_in(const std::string& part, const std::string& whole) {
  EXPECT_NE(whole.find(part), std::string::npos) << "missing: " << part << "\nin: " << whole;
}

TEST(CaseFile, ReadsEveryType) {
  const auto outcome = apply(
      "[wing]\nmach = 0.7\ngamma = 2\nblocks = 3\nmoving = true\nscheme = \"roe\"\ncells = [16, 8]\n"
      "speeds = [1, 2.5]\naxis = [0.25, 0.0]\n");
  ASSERT_EQ(outcome.message, "");
  EXPECT_EQ(outcome.wing.mach, 0.7);
  EXPECT_EQ(outcome.wing.gamma, 2.0);  // an integer serves as a number
  EXPECT_EQ(outcome.wing.blocks, 3);
  EXPECT_TRUE(outcome.wing.moving);
  EXPECT_EQ(outcome.wing.scheme, "roe");
  EXPECT_EQ(outcome.wing.cells, (std::array<int, 2>{16, 8}));
  EXPECT_EQ(outcome.wing.speeds, (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(outcome.wing.axis, (std::array<double, 2>{0.25, 0.0}));
}

TEST(CaseFile, DefaultsHoldWhereNothingIsGiven) {
  const auto outcome = apply("");
  ASSERT_EQ(outcome.message, "");
  EXPECT_EQ(outcome.wing.mach, 0.8);
  EXPECT_FALSE(outcome.wing.axis.has_value());
}

TEST(CaseFile, MisspeltKeyNamesPlaceValueAndNearestName) {
  const auto outcome = apply("[wing]\n\nmatch = 0.7\n");
  expect_in("case.toml:3: wing.match = 0.7: unknown key; did you mean wing.mach?", outcome.message);
  expect_in("keys of [wing]: mach, gamma,", outcome.message);
}

TEST(CaseFile, KeyInTheWrongSectionIsSentToItsOwn) {
  expect_in("case.toml:2: wing.mass_ratio = 3: unknown key; did you mean mass.mass_ratio?",
            apply("[wing]\nmass_ratio = 3\n").message);
}

TEST(CaseFile, UnknownSectionNamesTheNearestAndTheKnown) {
  expect_in("case.toml:1: [wign]: unknown section; did you mean [wing]?; sections: wing, mass",
            apply("[wign]\nmach = 0.7\n").message);
}

TEST(CaseFile, WrongTypeSaysWhatIsExpectedAndWhatWasGiven) {
  expect_in("case.toml:2: wing.mach = \"fast\": expected number: 0.05 to 3, got a text",
            apply("[wing]\nmach = \"fast\"\n").message);
  expect_in("expected integer: 1 to 64, got a number with a fraction",
            apply("[wing]\nblocks = 2.0\n").message);
  expect_in("expected two integers, got a list of 3", apply("[wing]\ncells = [1, 2, 3]\n").message);
  expect_in("entry 2: expected two integers", apply("[wing]\ncells = [16, \"x\"]\n").message);
  expect_in("expected text: \"jst\", \"roe\", got an integer", apply("[wing]\nscheme = 4\n").message);
}

TEST(CaseFile, OutOfRangeNamesTheRange) {
  expect_in("case.toml:2: wing.mach = 4.5: out of range; allowed: 0.05 to 3",
            apply("[wing]\nmach = 4.5\n").message);
  expect_in("out of range; allowed: > 1", apply("[wing]\ngamma = 1.0\n").message);
  expect_in("wing.speeds = [ 1.0, -2.0 ]: entry 2: out of range; allowed: > 0 m/s",
            apply("[wing]\nspeeds = [1.0, -2.0]\n").message);
  EXPECT_EQ(apply("[wing]\nmach = 3\n").message, "");
  EXPECT_EQ(apply("[wing]\nmach = 0.05\n").message, "");
  expect_in("out of range", apply("[wing]\nblocks = 9223372036854775807\n").message);
}

TEST(CaseFile, RefusesNumbersThatAreNotFinite) {
  for (const std::string value : {"nan", "inf", "-inf"})
    expect_in("not a finite number", apply("[wing]\nmach = " + value + "\n").message);
}

TEST(CaseFile, TextOutsideTheSetNamesTheSetAndTheNearest) {
  expect_in("case.toml:2: wing.scheme = \"reo\": allowed: \"jst\", \"roe\"; did you mean \"roe\"?",
            apply("[wing]\nscheme = \"reo\"\n").message);
}

TEST(CaseFile, AllFaultsComeAtOnceInTheOrderOfTheText) {
  const std::string message =
      apply("[wing]\nscheme = \"x\"\nmach = 9\n[wung]\na = 1\n", {"wing.gamma=0"}, {"wing", "mass"}).message;
  expect_in("5 faults in the case:", message);
  expect_in("[wung]", message);
  expect_in("case.toml: mass.mass_ratio: missing; wingbeat fly needs it: mass ratio (number, > 0)", message);
  EXPECT_LT(message.find("case.toml:2"), message.find("case.toml:3"));
  EXPECT_LT(message.find("case.toml:3"), message.find("command line: wing.gamma=0: out of range"));
}

TEST(CaseFile, RequiredKeyIsNeededOnlyWhereItsSectionIsUsed) {
  EXPECT_EQ(apply("", {}, {"wing"}).message, "");
  expect_in("mass.mass_ratio: missing", apply("", {}, {"mass"}).message);
  EXPECT_EQ(apply("[mass]\nmass_ratio = 75\n", {}, {"mass"}).message, "");
  // A value that is there but wrong is not reported as missing, too.
  EXPECT_EQ(apply("[mass]\nmass_ratio = 0\n", {}, {"mass"}).message,
            "case.toml:2: mass.mass_ratio = 0: out of range; allowed: > 0");
}

TEST(CaseFile, SyntaxErrorNamesLineAndColumn) {
  const std::string message = apply("[wing]\nmach = = 3\n").message;
  expect_in("case.toml:2:", message);
  expect_in("not valid TOML", message);
}

TEST(CaseFile, KeyOutsideASectionIsExplained) {
  expect_in("case.toml:1: mach = 0.7: a key outside a section", apply("mach = 0.7\n").message);
}

TEST(CaseFile, RuleIsBlamedOnItsKeyAndSkippedWhileAKeyIsWrong) {
  expect_in("case.toml:3: wing.blocks = 20: more blocks than cells around",
            apply("[wing]\ncells = [16, 8]\nblocks = 20\n").message);
  const std::string message = apply("[wing]\ncells = [16, 8]\nblocks = 20\nmach = 9\n").message;
  EXPECT_EQ(message.find("more blocks"), std::string::npos);
}

TEST(Override, IsReadAsTomlAndFailingThatAsText) {
  const auto outcome = apply("[wing]\nmach = 0.7\nscheme = \"jst\"\n",
                             {"wing.mach=0.9", "wing.scheme=roe", "wing.cells=[32,16]", "wing.mach=0.95"});
  ASSERT_EQ(outcome.message, "");
  EXPECT_EQ(outcome.wing.mach, 0.95);  // the last one holds
  EXPECT_EQ(outcome.wing.scheme, "roe");
  EXPECT_EQ(outcome.wing.cells, (std::array<int, 2>{32, 16}));
}

TEST(Override, ReplacesAFaultyValueOfTheText) {
  EXPECT_EQ(apply("[wing]\nmach = 9\n", {"wing.mach=0.9"}).message, "");
}

TEST(Override, CannotSmuggleInAnotherKey) {
  expect_in("got a text", apply("", {"wing.mach=0.9\ngamma = 2"}).message);
}

TEST(Override, FaultsNameTheCommandLine) {
  expect_in("command line: wing.mach=9: out of range", apply("", {"wing.mach=9"}).message);
  expect_in("command line: wing.match=0.8: unknown key; did you mean wing.mach?",
            apply("", {"wing.match=0.8"}).message);
  expect_in("command line: [wign]: unknown section", apply("", {"wign.mach=0.8"}).message);
  for (const std::string wrong : {"wing", "mach=0.8", "wing.=1", ".mach=1", "a.b.c=1"})
    expect_in("command line: " + wrong + ": expected section.key=value", apply("", {wrong}).message);
  EXPECT_EQ(apply("", {"wing.scheme=jst"}).message, "");
}

class CaseFileFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("wingbeat-case-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "mesh.cgns") << "x";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(CaseFileFolder, PathsAreRelativeToTheCaseFile) {
  const std::string name = (folder_ / "case.toml").string();
  const auto outcome = apply("[wing]\nfile = \"mesh.cgns\"\n", {}, {"wing"}, name);
  ASSERT_EQ(outcome.message, "");
  EXPECT_EQ(outcome.wing.file, (folder_ / "mesh.cgns").string());
  EXPECT_EQ(apply("", {"wing.file=mesh.cgns"}, {"wing"}, name).wing.file, (folder_ / "mesh.cgns").string());
}

TEST_F(CaseFileFolder, MissingFileIsNamedInFull) {
  const std::string name = (folder_ / "case.toml").string();
  const std::string message = apply("[wing]\nfile = \"none.cgns\"\n", {}, {"wing"}, name).message;
  expect_in(name + ":2: wing.file = \"none.cgns\": no such file: " + (folder_ / "none.cgns").string(),
            message);
  expect_in("a folder, not a file", apply("[wing]\nfile = \".\"\n", {}, {"wing"}, name).message);
}

TEST(ResolvedCase, ReadsBackToTheSameValuesAndSaysWhereTheyCameFrom) {
  const auto first = apply("[wing]\nmach = 0.7\naxis = [0.1, 1e-17]\nspeeds = [60.0, 0.1]\n",
                           {"wing.gamma=1.3333333333333333"});
  ASSERT_EQ(first.message, "");
  expect_in("# case.toml:2", first.resolved);
  expect_in("# command line", first.resolved);
  expect_in("# default", first.resolved);
  EXPECT_EQ(first.resolved.find("mass_ratio"), std::string::npos);  // required, of an unused section
  const auto second = apply(first.resolved);
  ASSERT_EQ(second.message, "");
  EXPECT_EQ(second.wing.mach, first.wing.mach);
  EXPECT_EQ(second.wing.gamma, first.wing.gamma);
  EXPECT_EQ(second.wing.axis, first.wing.axis);
  EXPECT_EQ(second.wing.speeds, first.wing.speeds);
  EXPECT_EQ(second.wing.cells, first.wing.cells);
}

TEST(TomlText, NumbersReadBackExactlyAndStayFloats) {
  EXPECT_EQ(toml_text(60.0), "60.0");
  EXPECT_EQ(toml_text(-2.0), "-2.0");
  EXPECT_EQ(toml_text(1e-6), "1e-06");
  EXPECT_EQ(std::stod(toml_text(0.1)), 0.1);
  EXPECT_EQ(toml_text(std::string("a\"b\\c\n")), "\"a\\\"b\\\\c\\u000A\"");
}

TEST(Reference, NamesEveryKeyWithItsDefaultRangeAndUnit) {
  WingSettings wing;
  SettingRegistry registry;
  registry.add_section("wing", "The wing.", wing);
  const std::string table = reference_table(registry), page = reference_markdown(registry);
  for (const auto& key : registry.find("wing")->keys()) {
    expect_in(key.name, table);
    expect_in("| `" + key.name + "` |", page);
  }
  expect_in("| `mach` | number | 0.8 | 0.05 to 3 | - | Mach number |", page);
  expect_in("| `speeds` | list of numbers | [] | > 0 | m/s | speeds |", page);
  expect_in("| `axis` | two numbers | unset | any | chords | axis |", page);
}

TEST(SettingSection, RefusesAKeyDeclaredTwice) {
  double value = 0.0;
  SettingSection section("wing", "");
  section.add("mach", &value, {});
  EXPECT_THROW(section.add("mach", &value, {}), InternalError);
}

}  // namespace
}  // namespace wingbeat
