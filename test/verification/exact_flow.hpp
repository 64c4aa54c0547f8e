#pragma once

#include <functional>
#include <numbers>

#include "test/flow/flow_case.hpp"

namespace wingbeat::testing {

// (density, velocities, pressure) at a point, written for any number type: an exact flow.
template <int Dim, class T>
using Primitive = Vec<T, Dim + 2>;

template <int Dim, class T>
State<Dim, T> conservative_of(const Primitive<Dim, T>& q, double gamma) {
  Vec<T, Dim> u;
  for (int d = 0; d < Dim; ++d) u[d] = q[1 + d];
  return conservative<Dim, T>(q[0], u, q[Dim + 1], gamma);
}

// Three Gauss points a direction over every cell of a one-zone mesh: calls f(cell number, point,
// weight), the weight being volume.
template <int Dim, class F>
void for_each_quadrature_point(const MultiblockMesh<Dim>& mesh, F&& f) {
  constexpr std::array<double, 3> point{0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr std::array<double, 3> weight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  const Zone<Dim>& zone = mesh.zones[0];
  std::size_t number = 0;
  for_each(box_of<Dim>(zone.cells), [&](const Index<Dim>& cell) {
    Index<Dim> extents;
    extents.fill(3);
    for_each(box_of<Dim>(extents), [&](const Index<Dim>& gauss) {
      // The multilinear map of the cell at the point, with its derivatives.
      using D = Dual<double, Dim>;
      Vec<D, Dim> x;
      double volume = 1.0;
      for (std::size_t corner = 0; corner < std::size_t{1} << Dim; ++corner) {
        D share(1.0);
        Index<Dim> node = cell;
        for (int d = 0; d < Dim; ++d) {
          const bool high = (corner >> d & 1) != 0;
          const D t = D::seed(point[static_cast<std::size_t>(gauss[d])], d);
          share *= high ? t : 1.0 - t;
          node[d] += high;
        }
        for (int d = 0; d < Dim; ++d) x[d] += zone.nodes(node)[d] * share;
      }
      for (int d = 0; d < Dim; ++d) volume *= weight[static_cast<std::size_t>(gauss[d])];
      Vec<double, Dim> at;
      for (int d = 0; d < Dim; ++d) at[d] = x[d].value;
      const auto& a = x[0].gradient;
      const auto& b = x[1].gradient;
      if constexpr (Dim == 2)
        volume *= a[0] * b[1] - a[1] * b[0];
      else
        volume *= dot(a, cross(b, x[2].gradient));
      f(number, at, volume);
    });
    ++number;
  });
}

// Cell averages of an exact flow, and the source that makes it steady: the integral of div F.
template <int Dim>
struct CellIntegrals {
  std::vector<double> average;  // [cell][variable]
  std::vector<double> source;
};

template <int Dim, class Flow>
CellIntegrals<Dim> integrate(const MultiblockMesh<Dim>& mesh, const Flow& flow, double gamma) {
  constexpr int n = state_size<Dim>;
  using D = Dual<double, Dim>;
  CellIntegrals<Dim> result;
  result.average.assign(mesh.cell_count() * n, 0.0);
  result.source.assign(mesh.cell_count() * n, 0.0);
  std::vector<double> volume(mesh.cell_count(), 0.0);
  for_each_quadrature_point<Dim>(mesh, [&](std::size_t cell, const Vec<double, Dim>& at, double weight) {
    Vec<D, Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = D::seed(at[d], d);
    const State<Dim, D> w = conservative_of<Dim, D>(flow(x), gamma);
    const D p = pressure<Dim, D>(w, gamma);
    volume[cell] += weight;
    for (int v = 0; v < n; ++v) result.average[cell * n + v] += weight * w[v].value;
    for (int d = 0; d < Dim; ++d) {
      Vec<double, Dim> unit{};
      unit[d] = 1.0;
      const auto flux = euler_flux<Dim, D, double>(w, p, unit, 0.0);
      for (int v = 0; v < n; ++v) result.source[cell * n + v] += weight * flux[v].gradient[d];
    }
  });
  for (std::size_t i = 0; i < result.average.size(); ++i) result.average[i] /= volume[i / n];
  return result;
}

// sqrt(sum over cells of Omega |e|^2), e per cell.
inline double l2_norm(std::span<const double> error, std::span<const double> volumes) {
  double sum = 0.0;
  const std::size_t n = error.size() / volumes.size();
  for (std::size_t i = 0; i < error.size(); ++i) sum += volumes[i / n] * error[i] * error[i];
  return std::sqrt(sum);
}

}  // namespace wingbeat::testing
