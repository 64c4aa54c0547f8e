#include "core/mesh/fourier.hpp"

#include <numbers>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

using Complex = std::complex<double>;

std::size_t smallest_prime_factor(std::size_t n) {
  for (std::size_t p = 2; p * p <= n; ++p)
    if (n % p == 0) return p;
  return n;
}

// Without the NaN recovery of the standard operator, which costs more than the product.
Complex product(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

FourierTransform::FourierTransform(int length) : roots_(static_cast<std::size_t>(length > 0 ? length : 0)) {
  ensure(length > 0, "length of a Fourier transform must be positive");
  for (int k = 0; k < length; ++k) roots_[k] = std::polar(1.0, -2.0 * std::numbers::pi * k / length);
}

void FourierTransform::forward(std::span<const Complex> in, std::span<Complex> out) const {
  ensure(in.size() == roots_.size() && out.size() == roots_.size(), "wrong length in a Fourier transform");
  transform(in.data(), out.data(), roots_.size(), 1);
}

void FourierTransform::backward(std::span<const Complex> in, std::span<Complex> out) const {
  forward(in, out);
  for (std::size_t lo = 1, hi = out.size() - 1; lo < hi; ++lo, --hi) std::swap(out[lo], out[hi]);
}

// Decimation in time: p transforms of n/p values each, then p-point butterflies.
void FourierTransform::transform(const Complex* in, Complex* out, std::size_t n, std::size_t stride) const {
  if (n == 1) {
    *out = *in;
    return;
  }
  const std::size_t p = smallest_prime_factor(n), m = n / p;
  for (std::size_t q = 0; q < p; ++q) transform(in + q * stride, out + q * m, m, stride * p);
  if (p == 2) {
    for (std::size_t k = 0; k < m; ++k) {
      const Complex even = out[k], odd = product(roots_[k * stride], out[k + m]);
      out[k] = even + odd;
      out[k + m] = even - odd;
    }
    return;
  }
  std::vector<Complex> values(p);
  for (std::size_t k = 0; k < m; ++k) {
    for (std::size_t q = 0; q < p; ++q) values[q] = out[q * m + k];
    for (std::size_t a = 0; a < p; ++a) {
      const std::size_t row = k + a * m;
      Complex sum = values[0];
      std::size_t turn = 0;
      for (std::size_t q = 1; q < p; ++q) {
        turn += row;
        if (turn >= n) turn -= n;
        sum += product(roots_[turn * stride], values[q]);
      }
      out[row] = sum;
    }
  }
}

}  // namespace wingbeat
