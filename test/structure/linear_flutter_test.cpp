// Theodorsen's flutter of typical sections through the root solver and through p-k.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/io/error.hpp"
#include "structure/flutter_roots.hpp"
#include "structure/pk.hpp"
#include "test/structure/theodorsen_cases.hpp"

namespace wingbeat {
namespace {

using Case = testing::TheodorsenCase;
const std::vector<Case>& cases = testing::theodorsen_cases;

AerodynamicMatrix flat_plate(double elastic_axis) {
  return [elastic_axis](double k) { return theodorsen_matrix(elastic_axis, k); };
}

FlutterRoot flutter_point(const std::vector<FlutterRoot>& roots) {
  for (const FlutterRoot& root : roots)
    if (root.is_destabilising()) return root;
  ADD_FAILURE() << "no flutter among " << roots.size() << " roots";
  return {};
}

double defect(const StructureModel& model, const Eigen::MatrixXcd& q, const FlutterRoot& root) {
  const double omega = root.frequency;
  const Eigen::MatrixXcd matrix = -omega * omega * model.mass +
                                  std::complex<double>(0.0, omega) * model.damping + model.stiffness -
                                  model.load(root.reduced_velocity) * q;
  return (matrix * root.mode).norm();
}

TEST(FlutterRoots, TheodorsensEightPointsToEightDigits) {
  for (const Case& expected : cases) {
    const TypicalSection& section = expected.section;
    SCOPED_TRACE(::testing::Message() << "U/(b omega_alpha) = " << expected.speed);
    const StructureModel model = structure_model(section);
    const AerodynamicMatrix exact = flat_plate(section.elastic_axis);
    const FlutterRoot root =
        flutter_point(flutter_roots(model, exact, testing::flat_plate_samples(section.elastic_axis, 16)));
    EXPECT_TRUE(root.is_converged);
    EXPECT_LE(root.evaluations, 3);
    EXPECT_NEAR(2.0 * root.reduced_velocity / expected.speed, 1.0, 1e-8);
    EXPECT_NEAR(root.frequency / expected.frequency, 1.0, 1e-8);
    EXPECT_LT(defect(model, exact(root.reduced_frequency), root), 1e-9);
  }
}

TEST(FlutterRoots, ReducedFrequencyMatchesTheReference) {
  const TypicalSection& section = cases[0].section;
  const FlutterRoot root = flutter_point(flutter_roots(
      structure_model(section), flat_plate(section.elastic_axis), testing::flat_plate_samples(-0.6, 12)));
  EXPECT_NEAR(root.reduced_frequency, .1181217544, 1e-10);
}

// A table that is off by some per cent, as one from a coarse mesh, costs three evaluations, not accuracy.
TEST(FlutterRoots, PolishNeedsFewEvaluationsFromACoarseTable) {
  const StructureModel model = structure_model(cases[0].section);
  const AerodynamicMatrix exact = flat_plate(-0.6);
  const AerodynamicMatrix coarse = [&](double k) -> Eigen::MatrixXcd {
    return (1.02 + std::complex<double>(0.01, 0.03) * k) * exact(k);
  };
  const AerodynamicTable table = tabulate(coarse, spread_reduced_frequencies(0.02, 1.5, 10));
  int evaluations = 0;
  const AerodynamicMatrix counted = [&](double k) {
    ++evaluations;
    return exact(k);
  };
  const FlutterRoot start = flutter_point(scan_flutter_roots(model, table));
  EXPECT_GT(std::abs(2.0 * start.reduced_velocity / cases[0].speed - 1.0), 1e-3);
  const FlutterRoot root = polish_flutter_root(model, counted, table, start);
  EXPECT_TRUE(root.is_converged);
  EXPECT_EQ(root.evaluations, evaluations);
  EXPECT_LE(evaluations, 3);
  EXPECT_NEAR(2.0 * root.reduced_velocity / cases[0].speed, 1.0, 1e-9);
}

TEST(FlutterRoots, GrowthSlopeIsThatOfTheNonlinearEigenvalue) {
  const StructureModel model = structure_model(cases[4].section);
  const AerodynamicMatrix exact = flat_plate(-0.2);
  const FlutterRoot root = flutter_point(flutter_roots(model, exact, testing::flat_plate_samples(-0.2, 24)));
  // Newton on (p, u) with Q continued analytically: p at V(1 +- h), central difference of Re p.
  const auto growth = [&](double velocity) {
    std::complex<double> p(0.0, root.frequency);
    const auto determinant = [&](std::complex<double> s) {
      const std::complex<double> k = s / std::complex<double>(0.0, 2.0 * velocity);
      const double k0 = root.reduced_frequency, d = 1e-4;
      const Eigen::MatrixXcd slope = (exact(k0 + d) - exact(k0 - d)) / (2.0 * d);
      const Eigen::MatrixXcd q = exact(k0) + (k - k0) * slope;
      return (s * s * model.mass + model.stiffness - model.load(velocity) * q).determinant();
    };
    for (int i = 0; i < 20; ++i) {
      const double d = 1e-6;
      p -= determinant(p) * 2.0 * d / (determinant(p + d) - determinant(p - d));
    }
    return p.real();
  };
  const double h = 1e-4 * root.reduced_velocity;
  const double slope = (growth(root.reduced_velocity + h) - growth(root.reduced_velocity - h)) / (2.0 * h);
  EXPECT_GT(slope, 0.0);
  EXPECT_NEAR(root.growth_slope / slope, 1.0, 1e-3);
}

// Two uncoupled aerofoils in one model: the roots of both, in order.
TEST(FlutterRoots, FindsEveryRootOfALargerModel) {
  const StructureModel first = structure_model(cases[0].section);
  const StructureModel second = structure_model(cases[3].section);
  StructureModel both;
  both.modes = {"h1", "a1", "h2", "a2"};
  const auto stack = [](const auto& a, const auto& b) {
    typename std::decay_t<decltype(a)>::PlainObject c(4, 4);
    c.setZero();
    c.topLeftCorner(2, 2) = a;
    c.bottomRightCorner(2, 2) = b;
    return c;
  };
  both.mass = stack(first.mass, second.mass);
  both.damping = stack(first.damping, second.damping);
  both.stiffness = stack(first.stiffness, second.stiffness);
  both.load_factor = first.load_factor;
  const AerodynamicMatrix exact = [&](double k) {
    const Eigen::MatrixXcd q = theodorsen_matrix(-0.6, k);
    return stack(q, q);
  };
  const AerodynamicTable table = tabulate(exact, spread_reduced_frequencies(0.02, 1.5, 16));
  std::vector<FlutterRoot> roots = flutter_roots(both, exact, table);
  std::erase_if(roots, [](const FlutterRoot& root) { return !root.is_destabilising(); });
  ASSERT_EQ(roots.size(), 2u);
  EXPECT_NEAR(2.0 * roots[0].reduced_velocity / cases[3].speed, 1.0, 1e-8);
  EXPECT_NEAR(2.0 * roots[1].reduced_velocity / cases[0].speed, 1.0, 1e-8);
}

// Weak damping turns the light crossing of a hump mode into two roots close together in k; stronger damping
// removes them. Q is built so that mode 2 has negative aerodynamic damping only near k = 0.5.
TEST(FlutterRoots, FindsTheNarrowHumpThatAScanCouldStepOver) {
  StructureModel model;
  model.modes = {"bending"};
  model.mass = model.stiffness = Eigen::MatrixXd::Identity(1, 1);
  model.damping = Eigen::MatrixXd::Zero(1, 1);
  model.load_factor = 0.1;
  const double half_width = 4e-3;
  const AerodynamicMatrix hump = [=](double k) -> Eigen::MatrixXcd {
    const double x = k - 0.5;
    return Eigen::MatrixXcd::Constant(1, 1, {0.0, 2.0 * (half_width * half_width - x * x)});
  };
  const AerodynamicTable table = tabulate(hump, spread_reduced_frequencies(0.1, 1.0, 5));
  FlutterOptions options;
  options.scan_steps = 20;  // 0.045 in k, several times the hump
  const std::vector<FlutterRoot> roots = flutter_roots(model, hump, table, options);
  ASSERT_EQ(roots.size(), 2u);
  // Im V/V = 0.1 (half_width^2 - x^2) up to sign: slope 8e-4 at the root, so 1e-10 there is 1.3e-7 in k.
  EXPECT_NEAR(roots[0].reduced_frequency, 0.5 + half_width, 2e-7);
  EXPECT_NEAR(roots[1].reduced_frequency, 0.5 - half_width, 2e-7);
  EXPECT_TRUE(roots[0].is_destabilising());
  EXPECT_FALSE(roots[1].is_destabilising());
  model.damping(0, 0) = 0.01;
  EXPECT_TRUE(flutter_roots(model, hump, table, options).empty());
}

TEST(FlutterRoots, UnloadedModesNeitherFlutterNorCrossByRoundOff) {
  const StructureModel model = structure_model(cases[0].section);
  const AerodynamicMatrix none = [](double) -> Eigen::MatrixXcd { return Eigen::MatrixXcd::Zero(2, 2); };
  const AerodynamicTable table = tabulate(none, spread_reduced_frequencies(0.02, 1.5, 8));
  EXPECT_TRUE(scan_flutter_roots(model, table).empty());
  const std::vector<double> speeds = {1.0, 2.0, 3.0, 4.0};
  EXPECT_TRUE(pk(model, none, 0.0, 10.0, speeds).crossings.empty());
}

// Structural damping raises the flutter speed, and p-k sees the same point.
TEST(FlutterRoots, AgreeWithPkWithStructuralDamping) {
  TypicalSection section = cases[5].section;
  section.damping = {0.01, 0.03};
  const StructureModel model = structure_model(section);
  const FlutterRoot root =
      flutter_point(flutter_roots(model, flat_plate(-0.2), testing::flat_plate_samples(-0.2, 24)));
  EXPECT_TRUE(root.is_converged);
  EXPECT_GT(2.0 * root.reduced_velocity, 1.01 * cases[5].speed);
  const std::vector<double> speeds = {0.2, 0.4, 0.6, 0.8, 1.0, 1.2};
  const PkResult result = pk(model, flat_plate(-0.2), 0.0, 100.0, speeds);
  ASSERT_EQ(result.crossings.size(), 1u);
  EXPECT_NEAR(result.crossings[0].point.reduced_velocity / root.reduced_velocity, 1.0, 1e-8);
}

TEST(FlutterRoots, RefusesRigidBodyModes) {
  StructureModel model = structure_model(cases[0].section);
  model.stiffness(0, 0) = 0.0;
  EXPECT_THROW(scan_flutter_roots(model, testing::flat_plate_samples(-0.6, 8)), InputError);
}

TEST(Divergence, MatchesTheClosedFormOfATypicalSection) {
  // K_alpha = q c^2 dC_m/dalpha, only with the elastic axis aft of the quarter chord.
  const TypicalSection section{-0.2, .2, .25, .4, 20.0};
  const std::vector<double> speeds =
      divergence_speeds(structure_model(section), theodorsen_matrix(-0.2, 0.0).real());
  ASSERT_EQ(speeds.size(), 1u);
  EXPECT_NEAR(2.0 * speeds[0], std::sqrt(20.0 * .25 / (2.0 * 0.3)), 1e-12);
  EXPECT_TRUE(
      divergence_speeds(structure_model(cases[0].section), theodorsen_matrix(-0.6, 0.0).real()).empty());
}

std::vector<double> speeds_up_to(double last, int count) {
  std::vector<double> speeds;
  for (int j = 1; j <= count; ++j) speeds.push_back(last * j / count);
  return speeds;
}

TEST(Pk, CrossesAtTheodorsensEightPoints) {
  for (const Case& expected : cases) {
    SCOPED_TRACE(::testing::Message() << "U/(b omega_alpha) = " << expected.speed);
    const PkResult result = pk(structure_model(expected.section), flat_plate(expected.section.elastic_axis),
                               0.0, 100.0, speeds_up_to(0.65 * expected.speed, 25));
    ASSERT_GE(result.crossings.size(), 1u);
    const PkCrossing& flutter = result.crossings.front();
    EXPECT_TRUE(flutter.is_destabilising);
    EXPECT_NEAR(2.0 * flutter.point.reduced_velocity / expected.speed, 1.0, 1e-8);
    EXPECT_NEAR(flutter.point.frequency() / expected.frequency, 1.0, 1e-8);
  }
}

TEST(Pk, StartsFromTheVacuumModesAndFollowsThem) {
  const StructureModel model = structure_model(cases[0].section);
  const std::vector<double> speeds = speeds_up_to(4.5, 60);
  const PkResult result = pk(model, flat_plate(-0.6), 0.0, 100.0, speeds);
  const VacuumModes free = vacuum_modes(model);
  ASSERT_EQ(result.branches.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<PkPoint>& branch = result.branches[i];
    ASSERT_EQ(branch.size(), speeds.size());
    // Apparent mass lowers the frequency by O(1/mu), 1.3 %.
    EXPECT_NEAR(branch.front().frequency() / free.frequencies[static_cast<Eigen::Index>(i)], 1.0, 0.02);
    for (std::size_t j = 0; j < branch.size(); ++j) {
      EXPECT_EQ(branch[j].status, PkStatus::converged);
      EXPECT_EQ(branch[j].reduced_velocity, speeds[j]);
      if (j == 0) continue;
      EXPECT_LT(std::abs(branch[j].p - branch[j - 1].p), 0.05) << "mode " << i << " at " << speeds[j];
    }
  }
  // Decaying below flutter, growing above.
  for (std::size_t j = 0; j < speeds.size(); ++j) {
    const bool flutters = result.branches[0][j].damping() > 0.0 || result.branches[1][j].damping() > 0.0;
    EXPECT_EQ(flutters, 2.0 * speeds[j] > cases[0].speed);
  }
}

TEST(Pk, EveryPointSatisfiesItsEquation) {
  StructureModel model = structure_model(cases[6].section);
  model.damping = modal_damping(model, Eigen::Vector2d(0.01, 0.02));
  const PkResult result = pk(model, flat_plate(-0.4), 0.0, 100.0, speeds_up_to(1.2, 12));
  for (const std::vector<PkPoint>& branch : result.branches)
    for (const PkPoint& point : branch) {
      const Eigen::MatrixXcd matrix =
          point.p * point.p * model.mass + point.p * model.damping + model.stiffness -
          model.load(point.reduced_velocity) * theodorsen_matrix(-0.4, point.reduced_frequency());
      EXPECT_LT((matrix * point.mode).norm(), 1e-10);
    }
}

TEST(Pk, SaysWhereItLeavesTheTable) {
  const StructureModel model = structure_model(cases[0].section);
  const AerodynamicTable table = testing::flat_plate_samples(-0.6, 16);  // k to 1.5
  const std::vector<double> speeds = speeds_up_to(4.0, 40);
  const PkResult result = pk(model, table, speeds);
  for (const std::vector<PkPoint>& branch : result.branches)
    for (const PkPoint& point : branch)
      EXPECT_EQ(point.status == PkStatus::outside_table, point.reduced_frequency() > table.k_max())
          << "V = " << point.reduced_velocity;
  EXPECT_EQ(result.branches[1].front().status, PkStatus::outside_table);
  ASSERT_EQ(result.crossings.size(), 1u);
  const FlutterRoot root = flutter_point(scan_flutter_roots(model, table));
  EXPECT_NEAR(result.crossings[0].point.reduced_velocity / root.reduced_velocity, 1.0, 1e-9);
}

TEST(Pk, RefusesSpeedsThatDoNotAscend) {
  const StructureModel model = structure_model(cases[0].section);
  EXPECT_THROW(pk(model, testing::flat_plate_samples(-0.6, 8), std::vector<double>{1.0, 1.0}), InputError);
  EXPECT_THROW(pk(model, testing::flat_plate_samples(-0.6, 8), std::vector<double>{0.0, 1.0}), InputError);
}

}  // namespace
}  // namespace wingbeat
