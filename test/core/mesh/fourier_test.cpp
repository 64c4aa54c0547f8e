#include "core/mesh/fourier.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <vector>

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

std::vector<Complex> sample(int n) {
  std::vector<Complex> values;
  for (int j = 0; j < n; ++j) values.emplace_back(std::sin(1.0 + 3.7 * j), std::cos(0.3 * j * j));
  return values;
}

TEST(FourierTransform, EqualsTheSumThatDefinesItForAnyLength) {
  for (const int n : {1, 2, 3, 8, 12, 30, 49, 97, 125}) {
    const auto in = sample(n);
    std::vector<Complex> out(in.size());
    FourierTransform(n).forward(in, out);
    for (int k = 0; k < n; ++k) {
      Complex sum = 0.0;
      for (int j = 0; j < n; ++j) sum += in[j] * std::polar(1.0, -2.0 * std::numbers::pi * (j * k % n) / n);
      EXPECT_NEAR(std::abs(out[k] - sum), 0.0, 1e-13 * n) << "length " << n;
    }
  }
}

TEST(FourierTransform, BackwardInvertsForward) {
  for (const int n : {1, 16, 250, 1021}) {
    const FourierTransform fourier(n);
    const auto in = sample(n);
    std::vector<Complex> spectrum(in.size()), out(in.size());
    fourier.forward(in, spectrum);
    fourier.backward(spectrum, out);
    for (int j = 0; j < n; ++j) EXPECT_NEAR(std::abs(out[j] / static_cast<double>(n) - in[j]), 0.0, 1e-13);
  }
}

}  // namespace
}  // namespace wingbeat
