#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <span>

#include "core/parallel/comm.hpp"

namespace wingbeat {

inline double conjugate(double value) { return value; }
inline std::complex<double> conjugate(std::complex<double> value) { return std::conj(value); }

// Inner products <a, b> (conjugating a) of this rank's entries, summed in eight interleaved
// lanes: a fixed order that vectorises without leave to reassociate.
inline double local_dot(std::span<const double> a, std::span<const double> b) {
  constexpr std::size_t lanes = 8;
  double sums[lanes] = {};
  const std::size_t whole = a.size() / lanes * lanes;
  for (std::size_t i = 0; i < whole; i += lanes)
    for (std::size_t l = 0; l < lanes; ++l) sums[l] += a[i + l] * b[i + l];
  double tail = 0.0;
  for (std::size_t i = whole; i < a.size(); ++i) tail += a[i] * b[i];
  for (std::size_t l = lanes / 2; l > 0; l /= 2)
    for (std::size_t i = 0; i < l; ++i) sums[i] += sums[i + l];
  return sums[0] + tail;
}

inline std::complex<double> local_dot(std::span<const std::complex<double>> a,
                                      std::span<const std::complex<double>> b) {
  constexpr std::size_t lanes = 4;
  double real[lanes] = {};
  double imaginary[lanes] = {};
  const auto add = [&](std::size_t lane, std::complex<double> p, std::complex<double> q) {
    real[lane] += p.real() * q.real() + p.imag() * q.imag();
    imaginary[lane] += p.real() * q.imag() - p.imag() * q.real();
  };
  const std::size_t whole = a.size() / lanes * lanes;
  for (std::size_t i = 0; i < whole; i += lanes)
    for (std::size_t l = 0; l < lanes; ++l) add(l, a[i + l], b[i + l]);
  for (std::size_t i = whole; i < a.size(); ++i) add(i - whole, a[i], b[i]);
  return {(real[0] + real[2]) + (real[1] + real[3]),
          (imaginary[0] + imaginary[2]) + (imaginary[1] + imaginary[3])};
}

// Euclidean norm over all ranks; NaN or infinite when an entry is.
template <class T>
double global_norm(const Comm& comm, std::span<const T> a) {
  return std::sqrt(comm.sum(std::real(local_dot(a, a))));
}

// y += factor x
inline void add_scaled(double factor, std::span<const double> x, std::span<double> y) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += factor * x[i];
}
// By parts: the operator of std::complex looks for infinities and does not vectorise.
inline void add_scaled(std::complex<double> factor, std::span<const std::complex<double>> x,
                       std::span<std::complex<double>> y) {
  const double re = factor.real();
  const double im = factor.imag();
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] = {y[i].real() + re * x[i].real() - im * x[i].imag(),
            y[i].imag() + re * x[i].imag() + im * x[i].real()};
}

template <class T>
void scale(double factor, std::span<T> y) {
  for (T& value : y) value *= factor;
}

}  // namespace wingbeat
