#include "adjoint/design_settings.hpp"

#include <gtest/gtest.h>

#include "core/io/case_file.hpp"
#include "test/core/mesh/message.hpp"

namespace wingbeat {
namespace {

DesignSettings read(const std::string& text) {
  DesignSettings design;
  SettingRegistry registry;
  registry.add_section("design", "", design);
  CaseFile("[design]\n" + text, "case.toml")
      .apply(
          registry, [] { return std::vector<std::string>{}; }, "a test");
  return design;
}

TEST(DesignSettings, DefaultsAreThePapersBumpsAndGridLines) {
  const DesignSettings design = read("");
  EXPECT_EQ(design.bumps, 24);
  EXPECT_EQ(design.bound, 0.01);
  EXPECT_EQ(design.bump_options().width, 3.0);
  EXPECT_FALSE(design.bump_options().symmetric);
  EXPECT_EQ(design.deformation_method(), DeformationMethod::grid_lines);
}

TEST(DesignSettings, ReadsEveryKey) {
  const DesignSettings design = read(
      "bumps = 2400\nbound = 0.02\nsymmetric = true\nbump_width = 2.0\ndeformation = \"inverse_distance\"\n");
  EXPECT_EQ(design.bump_options().bumps, 2400);
  EXPECT_EQ(design.bound, 0.02);
  EXPECT_TRUE(design.bump_options().symmetric);
  EXPECT_EQ(design.bump_options().width, 2.0);
  EXPECT_EQ(design.deformation_method(), DeformationMethod::inverse_distance);
}

TEST(DesignSettings, RefusesValuesOutOfRange) {
  const auto refusal = [](const std::string& text) { return example::message_of([&] { read(text); }); };
  example::expect_contains(refusal("bumps = 0"), "design.bumps");
  example::expect_contains(refusal("bound = 0.0"), "design.bound");
  example::expect_contains(refusal("bump_width = 0.5"), "design.bump_width");
  example::expect_contains(refusal("deformation = \"springs\""), "inverse_distance");
}

}  // namespace
}  // namespace wingbeat
