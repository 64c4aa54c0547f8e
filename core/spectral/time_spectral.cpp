#include "core/spectral/time_spectral.hpp"

#include <algorithm>
#include <numbers>
#include <string>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// e^{i h theta_n}, its argument reduced to one period so that high harmonics keep their digits.
std::complex<double> unit_root(int h, int n, int instances) {
  return std::polar(1.0, two_pi * ((h * n) % instances) / instances);
}

}  // namespace

TimeSpectral::TimeSpectral(int harmonics) : harmonics_(harmonics) {
  ensure(harmonics >= 0, "TimeSpectral: " + std::to_string(harmonics) + " harmonics");
  const int count = instances();
  derivative_.assign(static_cast<std::size_t>(count * count), 0.0);
  for (int n = 0; n < count; ++n) {
    for (int m = 0; m < n; ++m) {
      const double sign = (n - m) % 2 == 0 ? 1.0 : -1.0;
      const double value = 0.5 * sign / std::sin(std::numbers::pi * (n - m) / count);
      derivative_[static_cast<std::size_t>(n * count + m)] = value;
      derivative_[static_cast<std::size_t>(m * count + n)] = -value;
    }
  }
}

double TimeSpectral::phase(int n) const { return two_pi * n / instances(); }

void TimeSpectral::add_derivative(double scale, std::span<const double> f, std::span<double> df) const {
  const auto count = static_cast<std::size_t>(instances());
  ensure(f.size() == df.size() && f.size() % count == 0, "TimeSpectral: field of a wrong size");
  const std::size_t width = f.size() / count;
  constexpr std::size_t chunk = 512;  // the same stretch of every instance stays in cache
  for (std::size_t begin = 0; begin < width; begin += chunk) {
    const std::size_t end = std::min(begin + chunk, width);
    for (std::size_t n = 0; n < count; ++n) {
      double* const target = df.data() + n * width;
      for (std::size_t m = 0; m < count; ++m) {
        if (m == n) continue;
        const double weight = scale * derivative_[n * count + m];
        const double* const source = f.data() + m * width;
        for (std::size_t j = begin; j < end; ++j) target[j] += weight * source[j];
      }
    }
  }
}

std::vector<std::complex<double>> TimeSpectral::harmonics_of(std::span<const double> f) const {
  const int count = instances();
  ensure(f.size() % static_cast<std::size_t>(count) == 0, "TimeSpectral: field of a wrong size");
  const std::size_t width = f.size() / static_cast<std::size_t>(count);
  std::vector<std::complex<double>> coefficients(width * static_cast<std::size_t>(harmonics_ + 1));
  for (int h = 0; h <= harmonics_; ++h) {
    std::complex<double>* const target = coefficients.data() + h * width;
    for (int n = 0; n < count; ++n) {
      const auto weight = (h == 0 ? 1.0 : 2.0) / count * std::conj(unit_root(h, n, count));
      const double* const source = f.data() + n * width;
      for (std::size_t j = 0; j < width; ++j) target[j] += weight * source[j];
    }
  }
  return coefficients;
}

std::vector<double> TimeSpectral::instances_of(std::span<const std::complex<double>> coefficients) const {
  const auto terms = static_cast<std::size_t>(harmonics_ + 1);
  ensure(coefficients.size() % terms == 0, "TimeSpectral: coefficients of a wrong size");
  const std::size_t width = coefficients.size() / terms;
  const int count = instances();
  std::vector<double> f(width * static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) {
    double* const target = f.data() + n * width;
    for (int h = 0; h <= harmonics_; ++h) {
      const auto root = unit_root(h, n, count);
      const std::complex<double>* const source = coefficients.data() + h * width;
      for (std::size_t j = 0; j < width; ++j)
        target[j] += source[j].real() * root.real() - source[j].imag() * root.imag();
    }
  }
  return f;
}

}  // namespace wingbeat
