#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "flow/gas.hpp"

// Comparisons that tests of kernels share.
namespace wingbeat::testing {

inline constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();

template <int N>
void expect_close(const Vec<double, N>& a, const Vec<double, N>& b, double tolerance = round_off) {
  double size = 1.0;
  for (int i = 0; i < N; ++i) size = std::max(size, std::abs(b[i]));
  for (int i = 0; i < N; ++i) EXPECT_NEAR(a[i], b[i], tolerance * size) << "component " << i;
}

// Gradients of a kernel, a function of `inputs` numbers, against central differences: truncation
// and round-off are each about 1e-10 at this step.
template <int Inputs, class Kernel>
void expect_gradients(const Vec<double, Inputs>& at, const Kernel& kernel) {
  using D = Dual<double, Inputs>;
  constexpr double h = 1e-5;
  Vec<D, Inputs> seeded;
  for (int i = 0; i < Inputs; ++i) seeded[i] = D::seed(at[i], i);
  const auto exact = kernel(seeded);
  const auto value = kernel(at);
  for (int v = 0; v < exact.size(); ++v) EXPECT_NEAR(exact[v].value, value[v], round_off);
  for (int i = 0; i < Inputs; ++i) {
    Vec<double, Inputs> up = at, down = at;
    up[i] += h;
    down[i] -= h;
    const auto high = kernel(up), low = kernel(down);
    for (int v = 0; v < exact.size(); ++v)
      EXPECT_NEAR(exact[v].gradient[i], (high[v] - low[v]) / (2 * h),
                  2e-8 * (1.0 + std::abs(exact[v].gradient[i])))
          << "row " << v << ", column " << i;
  }
}

// The first `Cells` states of a line as one vector, and back.
template <int Dim, int Cells>
Vec<double, Cells * state_size<Dim>> flattened(const Vec<State<Dim, double>, 4>& w) {
  Vec<double, Cells * state_size<Dim>> x;
  for (int i = 0; i < x.size(); ++i) x[i] = w[i / state_size<Dim>][i % state_size<Dim>];
  return x;
}
template <int Dim, class T, int Size>
State<Dim, T> cell_of(const Vec<T, Size>& x, int k) {
  State<Dim, T> w;
  for (int v = 0; v < state_size<Dim>; ++v) w[v] = x[k * state_size<Dim> + v];
  return w;
}

// Plane states and vectors in space.
inline State<3, double> embedded(const State<2, double>& w) { return {{{w[0], w[1], w[2], 0.0, w[3]}}}; }
inline Vec<double, 3> embedded(const Vec<double, 2>& v) { return {{{v[0], v[1], 0.0}}}; }

}  // namespace wingbeat::testing
