#include "benchmarks/operation_count.hpp"

#include <cmath>

#include "flow/cell_quantities.hpp"
#include "flow/moved_face.hpp"
#include "flow/scheme/scheme.hpp"

namespace wingbeat::benchmarks {
namespace {

// A double that enters its operations in the count it came with; constants come with none.
struct Counted {
  double value = 0.0;
  OperationCount* count = nullptr;

  Counted() = default;
  Counted(double v, OperationCount* c = nullptr) : value(v), count(c) {}

  static Counted result(double v, const Counted& a, const Counted& b, double OperationCount::*kind) {
    OperationCount* const count = a.count ? a.count : b.count;
    if (count) count->*kind += 1.0;
    return {v, count};
  }
  friend Counted operator+(const Counted& a, const Counted& b) {
    return result(a.value + b.value, a, b, &OperationCount::additions_and_multiplications);
  }
  friend Counted operator-(const Counted& a, const Counted& b) {
    return result(a.value - b.value, a, b, &OperationCount::additions_and_multiplications);
  }
  friend Counted operator*(const Counted& a, const Counted& b) {
    return result(a.value * b.value, a, b, &OperationCount::additions_and_multiplications);
  }
  friend Counted operator/(const Counted& a, const Counted& b) {
    return result(a.value / b.value, a, b, &OperationCount::divisions);
  }
  friend Counted operator-(const Counted& a) { return {-a.value, a.count}; }
  Counted& operator+=(const Counted& b) { return *this = *this + b; }
  Counted& operator-=(const Counted& b) { return *this = *this - b; }
  Counted& operator*=(const Counted& b) { return *this = *this * b; }
  friend bool operator<(const Counted& a, const Counted& b) { return a.value < b.value; }

  friend Counted sqrt(const Counted& a) { return result(std::sqrt(a.value), a, a, &OperationCount::roots); }
  friend Counted select(bool condition, const Counted& a, const Counted& b) { return condition ? a : b; }
  friend Counted rough_inverse_cube_root(const Counted& a) {
    static_cast<void>(inverse_cube_root_bits(a));
    return {wingbeat::rough_inverse_cube_root(a.value), a.count};
  }
};

}  // namespace

template <int Dim>
OperationCount residual_operations() {
  using T = Counted;
  OperationCount count;
  const T one(1.0, &count);
  const JstScheme jst;
  const double gamma = 1.4;
  const RigidMotion<T> motion{one, one, one, one};
  State<Dim, T> w;
  for (int v = 0; v < state_size<Dim>; ++v) w[v] = one;
  w[Dim + 1] = T(4.0, &count);
  RestingFace<Dim, T> rest;
  for (int d = 0; d < Dim; ++d) rest.normal[d] = one;
  rest.moment = one;

  const T p = pressure<Dim, T>(w, gamma);
  Vec<Vec<T, Dim>, Dim> normals;
  Vec<T, Dim> sweeps;
  for (int d = 0; d < Dim; ++d) {
    const RestingFace<Dim, T> middle{0.5 * (rest.normal + rest.normal), 0.5 * (rest.moment + rest.moment)};
    const auto face = moved(middle, motion);
    normals[d] = face.normal;
    sweeps[d] = face.sweep;
  }
  const auto radii = scaled_radii(spectral_radii<Dim, T, T>(w, p, normals, sweeps, gamma));
  for (int d = 0; d < Dim; ++d) {
    const FaceStencil<Dim, T> stencil{{{w, w, w, w}}, {{p, p, p, p}}, {{radii[d], radii[d]}}};
    const auto face = moved(rest, motion);
    const auto flux = numerical_flux<Dim, T>(jst, stencil, face, gamma);
    // Each cell takes one difference of the fluxes a direction and adds it up.
    for (int v = 0; v < state_size<Dim>; ++v) static_cast<void>(one + (flux[v] - flux[v]));
  }
  return count;
}

template <int Dim>
double residual_values() {
  constexpr int n = state_size<Dim>, face = Dim + 1;
  constexpr int loading = 2 * n + n + 1;
  constexpr int radii = n + 1 + Dim * face + Dim;
  constexpr int fluxes = n + 1 + 1 + 1 + face + n;
  constexpr int differences = Dim * n + n;
  return loading + radii + Dim * fluxes + differences;
}

template OperationCount residual_operations<2>();
template OperationCount residual_operations<3>();
template double residual_values<2>();
template double residual_values<3>();

}  // namespace wingbeat::benchmarks
