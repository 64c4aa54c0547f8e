#include "structure/structure_model.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <limits>
#include <numbers>
#include <string>

#include "core/io/error.hpp"
#include "structure/typical_section.hpp"
#include "test/structure/section_refusal.hpp"

namespace wingbeat {
namespace {

using testing::message_of;

const TypicalSection paper_section{-0.6, .25, .75, .5, 75.0};

TEST(TypicalSection, HasItsVacuumFrequencies) {
  const VacuumModes modes = vacuum_modes(structure_model(paper_section));
  EXPECT_NEAR(modes.frequencies[0], .493427, 5e-7);
  EXPECT_NEAR(modes.frequencies[1], 1.058379, 5e-7);
}

TEST(TypicalSection, StatesItsUnits) {
  const StructureModel model = structure_model(paper_section);
  EXPECT_DOUBLE_EQ(model.load(3.0), 4.0 * 9.0 / (std::numbers::pi * 75.0));
  EXPECT_DOUBLE_EQ(elastic_axis_in_chords(paper_section), 0.2);
  EXPECT_DOUBLE_EQ(speed_index(paper_section, 3.0), 6.0 / std::sqrt(75.0));
  EXPECT_EQ(model.phase_mode, pitch_mode);
}

TEST(TypicalSection, RefusesValuesWithoutMeaningByTheirKey) {
  TypicalSection section = paper_section;
  section.static_unbalance = 0.9;
  EXPECT_NE(message_of(section).find("structure.static_unbalance = 0.9"), std::string::npos);
  section = paper_section;
  section.mass_ratio = -75.0;
  EXPECT_NE(message_of(section).find("structure.mass_ratio = -75"), std::string::npos);
  section = paper_section;
  section.frequency_ratio = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message_of(section).find("structure.frequency_ratio"), std::string::npos);
  section = paper_section;
  section.damping = {0.0, -0.1};
  EXPECT_NE(message_of(section).find("structure.damping = -0.1"), std::string::npos);
  EXPECT_EQ(message_of(paper_section), "accepted");
}

TEST(StructureModel, ModalDampingGivesEachModeItsRatio) {
  TypicalSection section = paper_section;
  section.damping = {0.02, 0.05};
  const StructureModel model = structure_model(section);
  const VacuumModes modes = vacuum_modes(model);
  Eigen::VectorXcd growth = (-first_order_matrix(model)).eigenvalues();
  for (const std::complex<double>& p : growth) {
    const int mode = std::abs(p) < 0.8 ? 0 : 1;
    EXPECT_NEAR(std::abs(p), modes.frequencies[mode], 1e-13);
    EXPECT_NEAR(-p.real() / std::abs(p), section.damping[static_cast<std::size_t>(mode)], 1e-13);
  }
}

TEST(StructureModel, RefusesMatricesThatAreNoStructure) {
  const StructureModel good = structure_model(paper_section);
  EXPECT_NO_THROW(check(good));
  StructureModel model = good;
  model.mass(0, 1) = model.mass(1, 0) = 2.0;
  EXPECT_THROW(check(model), InputError);
  model = good;
  model.stiffness(0, 1) = 0.1;
  EXPECT_THROW(check(model), InputError);
  model = good;
  model.damping = Eigen::MatrixXd::Zero(3, 3);
  EXPECT_THROW(check(model), InputError);
  model = good;
  model.phase_mode = 2;
  EXPECT_THROW(check(model), InputError);
  model = good;
  model.restoring = {polynomial_spring(2, 1.0, 0.0)};
  EXPECT_THROW(check(model), InputError);
}

TEST(RestoringForce, DerivativeIsThatOfItsValue) {
  const RestoringForce spring = polynomial_spring(0, -1.5, 50.0);
  const double u = 0.3, h = 1e-5;
  EXPECT_DOUBLE_EQ(spring.value(u), -1.5 * 0.027 + 50.0 * 0.00243);
  EXPECT_NEAR(spring.derivative(u), (spring.value(u + h) - spring.value(u - h)) / (2.0 * h), 1e-7);
}

}  // namespace
}  // namespace wingbeat
