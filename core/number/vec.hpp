#pragma once

#include <array>
#include <cstddef>

namespace wingbeat {

// Small fixed-length vector of any number type: points, area vectors, flow states.
template <class T, int N>
struct Vec {
  std::array<T, N> components{};

  constexpr T& operator[](int i) { return components[static_cast<std::size_t>(i)]; }
  constexpr const T& operator[](int i) const { return components[static_cast<std::size_t>(i)]; }
  static constexpr int size() { return N; }

  constexpr Vec& operator+=(const Vec& other) {
    for (int i = 0; i < N; ++i) (*this)[i] += other[i];
    return *this;
  }
  constexpr Vec& operator-=(const Vec& other) {
    for (int i = 0; i < N; ++i) (*this)[i] -= other[i];
    return *this;
  }
  template <class S>
  constexpr Vec& operator*=(const S& scale) {
    for (int i = 0; i < N; ++i) (*this)[i] *= scale;
    return *this;
  }
  friend constexpr Vec operator+(Vec a, const Vec& b) { return a += b; }
  friend constexpr Vec operator-(Vec a, const Vec& b) { return a -= b; }
  friend constexpr Vec operator-(Vec a) {
    for (int i = 0; i < N; ++i) a[i] = -a[i];
    return a;
  }
  template <class S>
  friend constexpr Vec operator*(const S& scale, Vec a) {
    return a *= scale;
  }
  friend constexpr bool operator==(const Vec&, const Vec&) = default;
};

template <class A, class B, int N>
constexpr auto dot(const Vec<A, N>& a, const Vec<B, N>& b) {
  auto sum = a[0] * b[0];
  for (int i = 1; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace wingbeat
