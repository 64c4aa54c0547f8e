#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <type_traits>

namespace wingbeat {

// Dense B x B blocks, row-major, and vectors of B. T is double or std::complex<double>.
template <int B>
inline constexpr std::size_t block_entries = static_cast<std::size_t>(B) * B;
template <class T, int B>
using SmallBlock = std::span<T, block_entries<B>>;
template <class T, int B>
using SmallVector = std::span<T, static_cast<std::size_t>(B)>;

// Complex numbers are taken by parts: the operator of std::complex looks for infinities and does not
// vectorise.
inline double product(double a, double b) { return a * b; }
inline std::complex<double> product(std::complex<double> a, std::complex<double> b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

// a x
template <class T, int B>
std::array<T, B> product(SmallBlock<const T, B> a, SmallVector<const T, B> x) {
  std::array<T, B> y{};
  for (int r = 0; r < B; ++r)
    for (int s = 0; s < B; ++s) y[r] += product(a[r * B + s], x[s]);
  return y;
}

// a^T x
template <class T, int B>
std::array<T, B> transposed_product(SmallBlock<const T, B> a, SmallVector<const T, B> x) {
  std::array<T, B> y{};
  for (int r = 0; r < B; ++r)
    for (int s = 0; s < B; ++s) y[s] += product(a[r * B + s], x[r]);
  return y;
}

// a b
template <class T, int B>
std::array<T, block_entries<B>> block_product(SmallBlock<const T, B> a, SmallBlock<const T, B> b) {
  std::array<T, block_entries<B>> c{};
  if constexpr (std::is_same_v<T, double>) {
    for (int r = 0; r < B; ++r)
      for (int k = 0; k < B; ++k)
        for (int s = 0; s < B; ++s) c[r * B + s] += a[r * B + k] * b[k * B + s];
  } else {
    // Rows as they lie in memory, (re, im) in turn: by the real and by the imaginary part of a.
    const double* const pairs = reinterpret_cast<const double*>(b.data());
    for (int r = 0; r < B; ++r) {
      double by_real[2 * B] = {}, by_imaginary[2 * B] = {};
      for (int k = 0; k < B; ++k) {
        const double real = a[r * B + k].real(), imaginary = a[r * B + k].imag();
        for (int s = 0; s < 2 * B; ++s) {
          by_real[s] += real * pairs[2 * B * k + s];
          by_imaginary[s] += imaginary * pairs[2 * B * k + s];
        }
      }
      for (int s = 0; s < B; ++s)
        c[r * B + s] = T(by_real[2 * s] - by_imaginary[2 * s + 1], by_real[2 * s + 1] + by_imaginary[2 * s]);
    }
  }
  return c;
}

}  // namespace wingbeat
