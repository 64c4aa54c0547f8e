#pragma once

#include <complex>
#include <span>
#include <vector>

namespace wingbeat {

// N = 2 N_H + 1 instances of a period at phases theta_n = 2 pi n / N, n = 0..N-1.
// D differentiates with respect to the phase, exactly for harmonics up to N_H;
// its eigenvalues are i m, |m| <= N_H  (eq:spectral-derivative).
// Fields are stored instance by instance: value j of instance n is f[n * width + j].
class TimeSpectral {
 public:
  explicit TimeSpectral(int harmonics);

  int harmonics() const { return harmonics_; }
  int instances() const { return 2 * harmonics_ + 1; }
  double phase(int n) const;
  double derivative(int n, int m) const { return derivative_[static_cast<std::size_t>(n * instances() + m)]; }

  // df += scale D f for fields of `width` values an instance; the transpose of D is -D.
  void add_derivative(double scale, std::span<const double> f, std::span<double> df) const;

  // Coefficients f_h = (2 - [h = 0])/N sum_n f(theta_n) e^{-i h theta_n}, h = 0..N_H, so that
  // f(theta) = sum_h Re(f_h e^{i h theta}). Layout [h][width].
  std::vector<std::complex<double>> harmonics_of(std::span<const double> f) const;
  // The instances of given coefficients: the inverse of harmonics_of.
  std::vector<double> instances_of(std::span<const std::complex<double>> coefficients) const;

 private:
  int harmonics_;
  std::vector<double> derivative_;
};

}  // namespace wingbeat
