// Q(k) over a range from two factorizations, against one factorization for every k.
#include "structure/sketched_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "structure/section_matrix.hpp"
#include "test/structure/resting_section.hpp"

namespace wingbeat {
namespace {

using namespace testing;

const std::vector<double> ks = spread_reduced_frequencies(0.02, 0.6, 9);

struct LinearizedRest : RestingSection {
  LinearizedRest() : RestingSection(0.5), section(*levels.back(), kinematics, rest(), 1e-10) {}
  double kappa(double k) const { return 2.0 * k * kinematics.flow_speed; }

  LinearizedSection<2> section;
};

// The greatest difference of an entry over the greatest entry.
double relative_difference(const std::vector<Eigen::MatrixXcd>& a, const std::vector<Eigen::MatrixXcd>& b) {
  double difference = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, (a[i] - b[i]).cwiseAbs().maxCoeff());
    largest = std::max(largest, b[i].cwiseAbs().maxCoeff());
  }
  return difference / largest;
}

// Where it is factored the projection holds the response itself, and with n derivatives the curve through it
// to the order n at least: halving the distance leaves 2^-(n+1) of the error.
TEST(ReducedResponse, IsExactWhereItIsFactoredAndCloseToTheOrderOfItsDerivatives) {
  LinearizedRest at_rest;
  constexpr double k = 0.2;
  const double kappa = at_rest.kappa(k);
  ReducedResponse<2> reduced(*at_rest.levels.back(), {&kappa, 1}, {.relative_tolerance = 1e-11});
  const auto error_at = [&](double other) {
    return (aerodynamic_matrix_of(reduced.at(at_rest.kappa(other))) -
            at_rest.section.aerodynamic_matrix(other))
        .norm();
  };
  for (int derivatives = 0; derivatives <= 2; ++derivatives) {
    reduced.extend();
    EXPECT_LE(error_at(k), 1e-8);
    EXPECT_GE(std::log2(error_at(1.2 * k) / error_at(1.1 * k)), derivatives + 0.9);
  }
}

TEST(SketchedMatrix, IsWithinTheAccuracyAskedFor) {
  LinearizedRest at_rest;
  const AerodynamicTable exact =
      tabulate([&](double k) { return at_rest.section.aerodynamic_matrix(k); }, ks);
  for (double accuracy : {0.03, 0.01}) {
    const auto sketch =
        sketched_matrix<2>(*at_rest.levels.back(), at_rest.kinematics.flow_speed, ks, accuracy, {});
    ASSERT_TRUE(sketch);
    const double error = relative_difference({sketch->samples().begin(), sketch->samples().end()},
                                             {exact.samples().begin(), exact.samples().end()});
    EXPECT_LE(error, accuracy);
    EXPECT_GT(error, 1e-9) << "as exact as the table: nothing was saved";
  }
}

TEST(SketchedMatrix, IsNothingWhereItsDerivativesDoNotDo) {
  LinearizedRest at_rest;
  EXPECT_FALSE(sketched_matrix<2>(*at_rest.levels.back(), at_rest.kinematics.flow_speed, ks, 1e-9, {}));
}

}  // namespace
}  // namespace wingbeat
