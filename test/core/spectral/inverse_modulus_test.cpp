#include "core/spectral/inverse_modulus.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace wingbeat {
namespace {

std::vector<double> applied(const std::vector<double>& weights, const std::vector<double>& f) {
  const std::size_t count = f.size();
  std::vector<double> result(count, 0.0);
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t m = 0; m < count; ++m) result[n] += weights[(n + count - m) % count] * f[m];
  return result;
}

TEST(InverseModulus, AppliedTwiceInvertsIdentityLessTheSquareOfTheDerivative) {
  for (int harmonics : {0, 1, 2, 5})
    for (double a : {0.0, 0.3, 7.0, 300.0}) {
      const TimeSpectral time(harmonics);
      const auto count = static_cast<std::size_t>(time.instances());
      std::vector<double> f(count), first(count, 0.0), g, weights(count);
      for (std::size_t n = 0; n < count; ++n) f[n] = std::cos(1.7 * static_cast<double>(n * n) + 0.4);
      time.add_derivative(a, f, first);
      g = f;
      time.add_derivative(-a, first, g);
      InverseModulus(time).weights(a, weights);
      const std::vector<double> back = applied(weights, applied(weights, g));
      // Round-off of g, which is as large as 1 + (harmonics a)^2.
      const double size = 1.0 + std::pow(harmonics * a, 2);
      for (std::size_t n = 0; n < count; ++n)
        EXPECT_NEAR(back[n], f[n], 1e-14 * size) << harmonics << ' ' << a;
    }
}

}  // namespace
}  // namespace wingbeat
