#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <experimental/simd>

#include "core/number/dual.hpp"
#include "core/number/pack.hpp"

// Elementary functions that read the same for double, Pack and Dual: kernels call these
// unqualified and never branch with `if` on a number. A branch decides on values; the branch
// taken is the derivative.
namespace wingbeat {

template <class T>
inline constexpr int lanes = 1;
template <>
inline constexpr int lanes<Pack> = static_cast<int>(Pack::size());
template <class T, int N>
inline constexpr int lanes<Dual<T, N>> = lanes<T>;

inline double sqrt(double x) { return std::sqrt(x); }
inline Pack sqrt(const Pack& x) { return std::experimental::sqrt(x); }
template <class T, int N>
Dual<T, N> sqrt(const Dual<T, N>& x) {
  const T root = sqrt(x.value);
  return chain(x, root, T(0.5) / root);
}

// x^exponent for x > 0.
inline double power(double x, double exponent) { return std::pow(x, exponent); }
template <class T, int N>
Dual<T, N> power(const Dual<T, N>& x, double exponent) {
  const T y = power(x.value, exponent);
  return chain(x, y, exponent * y / x.value);
}

inline double select(bool condition, double a, double b) { return condition ? a : b; }
inline Pack select(const Pack::mask_type& condition, const Pack& a, Pack b) {
  std::experimental::where(condition, b) = a;
  return b;
}
template <class Mask, class T, int N>
Dual<T, N> select(const Mask& condition, const Dual<T, N>& a, const Dual<T, N>& b) {
  Dual<T, N> result(select(condition, a.value, b.value));
  for (int i = 0; i < N; ++i) result.gradient[i] = select(condition, a.gradient[i], b.gradient[i]);
  return result;
}

template <class T>
T abs(const T& x) {
  return select(x < T(0.0), -x, x);
}
template <class T>
T max(const T& a, const T& b) {
  return select(a < b, b, a);
}
template <class T>
T min(const T& a, const T& b) {
  return select(b < a, b, a);
}

// x^(-1/3) for x > 0 to 4 %: the bits of a positive double, read as an integer, are nearly linear
// in its logarithm. The shift centres the error.
template <class T>
T inverse_cube_root_bits(const T& bits) {
  constexpr double bits_of_one = 4607182418800017408.0, shift = 0.068 * 4503599627370496.0;
  return (4.0 / 3.0 * bits_of_one - shift) - 1.0 / 3.0 * bits;
}
inline double rough_inverse_cube_root(double x) {
  const auto bits = static_cast<double>(std::bit_cast<std::int64_t>(x));
  return std::bit_cast<double>(static_cast<std::int64_t>(inverse_cube_root_bits(bits)));
}
inline Pack rough_inverse_cube_root(const Pack& x) {
  using namespace std::experimental;
  using Integers = rebind_simd_t<std::int64_t, Pack>;
  const auto bits = static_simd_cast<Pack>(std::bit_cast<Integers>(x));
  return std::bit_cast<Pack>(static_simd_cast<Integers>(inverse_cube_root_bits(bits)));
}

// x^(2/3) for x > 0, to round-off and without divisions: x y with y = x^(-1/3). A step of the
// iteration is the series of (1 - h)^(-1/3), h = 1 - x y^3, cut after h^3; it leaves 0.15 h^4.
template <class T>
T power_two_thirds(const T& x) {
  T y = rough_inverse_cube_root(x);
  for (int step = 0; step < 2; ++step) {
    const T h = 1.0 - x * y * y * y;
    y += y * h * (1.0 / 3.0 + h * (2.0 / 9.0 + h * (14.0 / 81.0)));
  }
  return x * y;
}
template <class T, int N>
Dual<T, N> power_two_thirds(const Dual<T, N>& x) {
  const T y = power_two_thirds(x.value);
  return chain(x, y, T(2.0 / 3.0) * y / x.value);
}

// Loads lanes<T> consecutive values, or one.
template <class T>
struct Load {
  static T from(const T* values) { return *values; }
};
template <>
struct Load<Pack> {
  static Pack from(const double* values) { return Pack(values, std::experimental::element_aligned); }
};
inline void store(const Pack& x, double* values) { x.copy_to(values, std::experimental::element_aligned); }
template <class T>
void store(const T& x, T* values) {
  *values = x;
}

}  // namespace wingbeat
