#pragma once

#include <type_traits>

#include "core/number/vec.hpp"

namespace wingbeat {

template <class T, int N>
struct Dual;
template <class T, int N>
Dual<T, N> chain(const Dual<T, N>& x, const T& f, const T& derivative);

// Number with its derivatives with respect to N seeds: forward differentiation.
// T is double or Pack. Comparisons look at values.
template <class T, int N>
struct Dual {
  T value{};
  Vec<T, N> gradient{};

  Dual() = default;
  Dual(const T& v) : value(v) {}  // implicit: a constant is a dual with zero gradient
  Dual(double v) requires(!std::is_same_v<T, double>) : value(v) {}

  static Dual seed(const T& v, int i) {
    Dual x(v);
    x.gradient[i] = T(1.0);
    return x;
  }

  Dual& operator+=(const Dual& b) {
    value += b.value;
    gradient += b.gradient;
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    value -= b.value;
    gradient -= b.gradient;
    return *this;
  }
  Dual& operator*=(const Dual& b) {
    for (int i = 0; i < N; ++i) gradient[i] = gradient[i] * b.value + value * b.gradient[i];
    value *= b.value;
    return *this;
  }
  Dual& operator/=(const Dual& b) {
    const T inverse = T(1.0) / b.value;
    value *= inverse;
    for (int i = 0; i < N; ++i) gradient[i] = (gradient[i] - value * b.gradient[i]) * inverse;
    return *this;
  }

  friend Dual operator-(Dual a) {
    a.value = -a.value;
    a.gradient = -a.gradient;
    return a;
  }
  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend Dual operator/(Dual a, const Dual& b) { return a /= b; }

  // Constants keep their zero gradient out of the arithmetic.
  friend Dual operator+(Dual a, double b) { return a.value += b, a; }
  friend Dual operator+(double a, Dual b) { return b.value += a, b; }
  friend Dual operator-(Dual a, double b) { return a.value -= b, a; }
  friend Dual operator-(double a, Dual b) { return a + (-b); }
  friend Dual operator*(Dual a, double b) { return a.scale(T(b)); }
  friend Dual operator*(double a, Dual b) { return b.scale(T(a)); }
  friend Dual operator/(Dual a, double b) { return a.scale(T(1.0 / b)); }
  friend Dual operator/(double a, const Dual& b) {
    const T quotient = T(a) / b.value;
    return chain(b, quotient, -quotient / b.value);
  }

  friend Dual operator+(Dual a, const T& b) requires(!std::is_same_v<T, double>) { return a.value += b, a; }
  friend Dual operator-(Dual a, const T& b) requires(!std::is_same_v<T, double>) { return a.value -= b, a; }
  friend Dual operator*(Dual a, const T& b) requires(!std::is_same_v<T, double>) { return a.scale(b); }
  friend Dual operator*(const T& a, Dual b) requires(!std::is_same_v<T, double>) { return b.scale(a); }

  friend auto operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend auto operator>(const Dual& a, const Dual& b) { return a.value > b.value; }

 private:
  Dual& scale(const T& factor) {
    value *= factor;
    gradient *= factor;
    return *this;
  }
};

// f(x) given f and f' at x.value.
template <class T, int N>
Dual<T, N> chain(const Dual<T, N>& x, const T& f, const T& derivative) {
  Dual<T, N> result(f);
  for (int i = 0; i < N; ++i) result.gradient[i] = derivative * x.gradient[i];
  return result;
}

// The same values as constants of another number type.
template <class D, class T, int N>
Vec<D, N> lifted(const Vec<T, N>& values) {
  Vec<D, N> result;
  for (int i = 0; i < N; ++i) result[i] = values[i];
  return result;
}

inline double value_of(double x) { return x; }
template <class T, int N>
T value_of(const Dual<T, N>& x) {
  return x.value;
}

}  // namespace wingbeat
