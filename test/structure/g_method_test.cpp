#include "structure/g_method.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "structure/flutter_roots.hpp"
#include "test/structure/theodorsen_cases.hpp"

namespace wingbeat {
namespace {

using testing::flat_plate_samples;
using testing::theodorsen_cases;
using testing::TheodorsenCase;

std::vector<double> speeds_up_to(double last, int count) {
  std::vector<double> speeds;
  for (int j = 1; j <= count; ++j) speeds.push_back(last * j / count);
  return speeds;
}

TEST(GMethod, CrossesWherePkDoes) {
  for (const TheodorsenCase& expected : theodorsen_cases) {
    SCOPED_TRACE(::testing::Message() << "U/(b omega_alpha) = " << expected.speed);
    const StructureModel model = structure_model(expected.section);
    const AerodynamicTable table = flat_plate_samples(expected.section.elastic_axis, 40);
    const std::vector<double> speeds = speeds_up_to(0.65 * expected.speed, 25);
    const PkResult by_pk = pk(model, table, speeds), by_g = g_method(model, table, speeds);
    ASSERT_EQ(by_g.crossings.size(), by_pk.crossings.size());
    ASSERT_GE(by_g.crossings.size(), 1u);
    // Both solve the same equation at Re p = 0, each to 1e-12.
    for (std::size_t i = 0; i < by_g.crossings.size(); ++i) {
      const PkPoint &a = by_g.crossings[i].point, &b = by_pk.crossings[i].point;
      EXPECT_NEAR(a.reduced_velocity / b.reduced_velocity, 1.0, 1e-9);
      EXPECT_NEAR(a.frequency() / b.frequency(), 1.0, 1e-9);
      EXPECT_EQ(by_g.crossings[i].is_destabilising, by_pk.crossings[i].is_destabilising);
    }
  }
}

TEST(GMethod, EveryPointSatisfiesItsEquation) {
  StructureModel model = structure_model(theodorsen_cases[6].section);
  model.damping = modal_damping(model, Eigen::Vector2d(0.01, 0.02));
  const AerodynamicTable table = flat_plate_samples(-0.4, 40);
  int checked = 0;
  for (const auto& branch : g_method(model, table, speeds_up_to(1.2, 12)).branches)
    for (const PkPoint& point : branch) {
      if (point.status != PkStatus::converged) continue;
      const double k = point.reduced_frequency(), g = point.p.real() / (2.0 * point.reduced_velocity);
      const Eigen::MatrixXcd q = table(k) - std::complex<double>(0.0, g) * table.derivative(k);
      const Eigen::MatrixXcd matrix = point.p * point.p * model.mass + point.p * model.damping +
                                      model.stiffness - model.load(point.reduced_velocity) * q;
      EXPECT_LT((matrix * point.mode).norm(), 1e-10);
      ++checked;
    }
  EXPECT_GE(checked, 10);
}

// The growth rate of the modes leaves zero with the slope of the true eigenvalue, which p-k misses: its Q
// does not know of damping.
TEST(GMethod, GrowsAtTheTrueRateNearTheBoundary) {
  const StructureModel model = structure_model(theodorsen_cases[4].section);
  const AerodynamicTable table = flat_plate_samples(-0.2, 60);
  const auto roots = scan_flutter_roots(model, table);
  ASSERT_EQ(roots.size(), 1u);
  const double v = roots[0].reduced_velocity, h = 1e-3 * v;
  std::vector<double> speeds = speeds_up_to(v - h, 20);
  speeds.push_back(v + h);
  const auto slope = [&](const PkResult& result) {
    for (const auto& branch : result.branches)
      if (branch.back().p.real() > 0.0)
        return (branch.back().p.real() - branch[branch.size() - 2].p.real()) / (2.0 * h);
    return 0.0;
  };
  const double exact = roots[0].growth_slope;
  // A central difference errs by (h/V)^2 relative, up to a factor of curvature.
  EXPECT_NEAR(slope(g_method(model, table, speeds)) / exact, 1.0, 1e-4);
  EXPECT_GT(std::abs(slope(pk(model, table, speeds)) / exact - 1.0), 1e-2);
}

}  // namespace
}  // namespace wingbeat
