#include "structure/springs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/io/error.hpp"
#include "structure/typical_section.hpp"
#include "test/structure/section_refusal.hpp"

namespace wingbeat {
namespace {

using testing::message_of;

constexpr double stiffness = 0.75, gap = 0.01, smoothing = 0.1;

const std::vector<double>& displacements() {
  static const std::vector<double> all{0.0,        1e-4,      0.5 * gap, 0.95 * gap, gap,
                                       1.02 * gap, 1.3 * gap, 3.0 * gap, 50.0 * gap};
  return all;
}

// Central differences err by h^2 g'''/6, g''' <= stiffness/width^2; round-off of g by 1e-16 gap/h.
TEST(Springs, DerivativesAreThoseOfTheirValues) {
  const double h = 1e-4 * smoothing * gap;
  for (const RestoringForce& spring :
       {freeplay_spring(0, stiffness, gap, smoothing), polynomial_spring(0, -300.0, 2e5)})
    for (double u : displacements()) {
      const double difference = (spring.value(u + h) - spring.value(u - h)) / (2.0 * h);
      EXPECT_NEAR(spring.derivative(u), difference, 1e-7 * std::max(1.0, std::abs(difference)))
          << "u = " << u;
    }
}

TEST(Springs, AreOdd) {
  for (const RestoringForce& spring :
       {freeplay_spring(0, stiffness, gap, smoothing), polynomial_spring(0, -300.0, 2e5)})
    for (double u : displacements()) {
      EXPECT_DOUBLE_EQ(spring.value(-u), -spring.value(u));
      EXPECT_DOUBLE_EQ(spring.derivative(-u), spring.derivative(u));
    }
}

// With the linear spring: no force inside the gap, k (u - gap) outside, but for e^(-2 distance/width).
TEST(Springs, FreeplayHasADeadZoneAndTheLinearSpringBeyondIt) {
  const RestoringForce spring = freeplay_spring(1, stiffness, gap, smoothing);
  EXPECT_EQ(spring.mode, 1);
  const double width = smoothing * gap;
  for (double u : {0.0, 0.3 * gap, 0.5 * gap, 1.5 * gap, 2.0 * gap, 20.0 * gap}) {
    const bool inside = u < gap;
    const double rounding = 4.0 * std::exp(-2.0 * std::abs(u - gap) / width);
    EXPECT_NEAR(stiffness * u + spring.value(u), inside ? 0.0 : stiffness * (u - gap),
                stiffness * width * rounding + 1e-15)
        << "u = " << u;
    EXPECT_NEAR(stiffness + spring.derivative(u), inside ? 0.0 : stiffness, stiffness * rounding + 1e-14);
  }
  // Half of the way at the corner itself.
  EXPECT_NEAR(spring.derivative(gap), -0.5 * stiffness, 1e-14);
}

TEST(Springs, OfASectionActOnTheirModesAndLeaveTheMatricesAlone) {
  TypicalSection section{-0.6, .25, .75, .5, 75.0};
  const StructureModel linear = structure_model(section);
  EXPECT_TRUE(linear.restoring.empty());
  section.plunge_spring = {1.5, 0.0, 0.0};
  section.pitch_spring = {-2.0, 40.0, 0.1};
  const StructureModel model = structure_model(section);
  EXPECT_EQ(model.stiffness, linear.stiffness);
  ASSERT_EQ(model.restoring.size(), 3u);
  EXPECT_EQ(model.restoring[0].mode, plunge_mode);
  EXPECT_DOUBLE_EQ(model.restoring[0].value(0.2), 1.5 * 0.008);
  EXPECT_EQ(model.restoring[1].mode, pitch_mode);
  EXPECT_DOUBLE_EQ(model.restoring[1].value(0.2), -2.0 * 0.008 + 40.0 * 0.00032);
  EXPECT_EQ(model.restoring[2].mode, pitch_mode);
  EXPECT_NEAR(model.restoring[2].value(1.0), -0.75 * 0.1, 1e-15);
}

TEST(Springs, RefuseValuesWithoutMeaningByTheirKey) {
  const TypicalSection good{-0.6, .25, .75, .5, 75.0};
  TypicalSection section = good;
  section.pitch_spring.freeplay = -0.1;
  EXPECT_NE(message_of(section).find("structure.pitch_freeplay_deg"), std::string::npos);
  section = good;
  section.plunge_spring.quintic = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message_of(section).find("structure.plunge_quintic"), std::string::npos);
  section = good;
  section.freeplay_smoothing = 0.0;
  EXPECT_NE(message_of(section).find("structure.freeplay_smoothing"), std::string::npos);
  EXPECT_THROW(freeplay_spring(0, 1.0, 0.0, 0.1), InputError);
  EXPECT_THROW(freeplay_spring(0, 1.0, 0.1, -1.0), InputError);
}

}  // namespace
}  // namespace wingbeat
