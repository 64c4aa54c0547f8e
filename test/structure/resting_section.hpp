#pragma once

#include <gtest/gtest.h>

#include <numbers>

#include "flow/steady_sequence.hpp"
#include "structure/linear_flutter.hpp"
#include "test/flow/flow_case.hpp"

namespace wingbeat::testing {

// A section at rest at a mean pitch in transonic flow, its steady flow solved.
struct RestingSection {
  FlowLevels<2> levels;
  SectionKinematics kinematics;

  explicit RestingSection(double mean_pitch_deg) {
    const FlowModel<2, double> model{{1.4, 0.796, 1.0, 0.0}, JstScheme{0.25, 1.0 / 64.0, 1.0}};
    kinematics.flow_speed = model.freestream.speed();
    kinematics.mean_pitch = mean_pitch_deg * std::numbers::pi / 180.0;
    levels.push_back(std::make_unique<FlowLevel<2>>(Comm(), section_mesh("naca64a010", 64, 16), model,
                                                    Vec<double, 2>{{{0.25, 0.0}}}, FlowLevelOptions{}));
    PseudoTransientOptions options;
    options.tolerance = 5e-12;
    EXPECT_EQ(solve_steady<2>(levels, {kinematics.mean_pitch, 0.0, 0.0}, options).status,
              SolveStatus::converged);
  }

  AeroelasticState rest() const { return {levels.back()->w, std::vector<double>(4, 0.0), 0.0, 1.0}; }
};

}  // namespace wingbeat::testing
