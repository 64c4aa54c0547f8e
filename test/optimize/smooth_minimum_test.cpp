#include "optimize/smooth_minimum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

using Numbers = std::vector<double>;

const std::vector<Numbers>& examples() {
  static const std::vector<Numbers> lists{
      {1.0, 1.0}, {0.9, 1.0, 1.3}, {-2.0, 5.0, -1.99, 0.0}, {3.0, 2.0, 2.01, 2.02, 2.0}};
  return lists;
}

TEST(SmoothMinimum, LiesBelowTheMinimumByNoMoreThanItsBound) {
  for (const Numbers& v : examples())
    for (const double sharpness : {1.0, 20.0, 100.0, 1e6})
      for (const double reference : {0.5, 3.0}) {
        const double least = *std::ranges::min_element(v);
        const double below = least - smooth_minimum(v, sharpness, reference).value;
        EXPECT_GE(below, 0.0);
        const double bound = reference * std::log(static_cast<double>(v.size())) / sharpness;
        EXPECT_LE(below, bound + 1e-15 * std::abs(least));
      }
}

TEST(SmoothMinimum, AttainsItsBoundWhereAllAreAlike) {
  const SmoothMinimum found = smooth_minimum(Numbers{2.0, 2.0, 2.0, 2.0}, 50.0, 0.7);
  EXPECT_NEAR(found.value, 2.0 - 0.7 * std::log(4.0) / 50.0, 1e-15);
  for (const double derivative : found.derivatives) EXPECT_EQ(derivative, 0.25);
}

TEST(SmoothMinimum, DerivativesAreWeightsOfSumOne) {
  for (const Numbers& v : examples()) {
    const auto derivatives = smooth_minimum(v, 100.0, 1.0).derivatives;
    ASSERT_EQ(derivatives.size(), v.size());
    EXPECT_NEAR(std::accumulate(derivatives.begin(), derivatives.end(), 0.0), 1.0, 1e-15);
    for (const double derivative : derivatives) EXPECT_GE(derivative, 0.0);
    const auto least = std::ranges::min_element(v) - v.begin();
    EXPECT_EQ(derivatives[static_cast<std::size_t>(least)], *std::ranges::max_element(derivatives));
  }
}

TEST(SmoothMinimum, DerivativesAreThoseOfCentralDifferences) {
  constexpr double step = 1e-4;
  for (const Numbers& v : examples())
    for (const double sharpness : {1.0, 20.0, 100.0}) {
      const double reference = 1.3, rate = sharpness / reference;
      const auto derivatives = smooth_minimum(v, sharpness, reference).derivatives;
      for (std::size_t i = 0; i < v.size(); ++i) {
        const auto value = [&](double h) {
          Numbers moved = v;
          moved[i] += h;
          return smooth_minimum(moved, sharpness, reference).value;
        };
        const double difference = (value(step) - value(-step)) / (2.0 * step);
        // The third derivative, rate^2 w (1 - w)(1 - 2 w), is below rate^2/10.
        EXPECT_NEAR(derivatives[i], difference, rate * rate * step * step / 60.0 + 1e-15 * 5.0 / step);
      }
    }
}

TEST(SmoothMinimum, OfOneNumberIsThatNumber) {
  for (const double v : {-3.0, 0.0, 0.7}) {
    const SmoothMinimum found = smooth_minimum(Numbers{v}, 100.0, 2.0);
    EXPECT_EQ(found.value, v);
    EXPECT_EQ(found.derivatives, Numbers{1.0});
  }
}

TEST(SmoothMinimum, DoesNotOverflow) {
  const SmoothMinimum found = smooth_minimum(Numbers{-1e6, 1e6, 0.0}, 1e3, 1.0);
  EXPECT_EQ(found.value, -1e6);
  EXPECT_EQ(found.derivatives, (Numbers{1.0, 0.0, 0.0}));
}

TEST(SmoothMinimum, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(smooth_minimum({}, 1.0, 1.0), InternalError);
  EXPECT_THROW(smooth_minimum(Numbers{1.0}, 0.0, 1.0), InternalError);
  EXPECT_THROW(smooth_minimum(Numbers{1.0}, 1.0, -1.0), InternalError);
}

}  // namespace
}  // namespace wingbeat
