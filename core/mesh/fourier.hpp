#pragma once

#include <complex>
#include <span>
#include <vector>

namespace wingbeat {

// Discrete Fourier transform of any length: mixed radix, O(n sum of the prime factors of n).
class FourierTransform {
 public:
  explicit FourierTransform(int length);

  // out[k] = sum_j in[j] e^{-2 pi i jk/n}; `in` and `out` have n values and do not overlap.
  void forward(std::span<const std::complex<double>> in, std::span<std::complex<double>> out) const;
  // out[j] = sum_k in[k] e^{+2 pi i jk/n}: n times the inverse of forward().
  void backward(std::span<const std::complex<double>> in, std::span<std::complex<double>> out) const;

  int length() const { return static_cast<int>(roots_.size()); }

 private:
  void transform(const std::complex<double>* in, std::complex<double>* out, std::size_t n,
                 std::size_t stride) const;

  std::vector<std::complex<double>> roots_;  // e^{-2 pi i k/n}
};

}  // namespace wingbeat
