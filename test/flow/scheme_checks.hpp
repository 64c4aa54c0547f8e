#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "test/flow/every_scheme.hpp"
#include "test/flow/kernel_checks.hpp"
#include "test/flow/kernel_states.hpp"

namespace wingbeat::testing {

// Calls test(scheme) for the schemes whose name passes, the scheme as the type that it is.
template <class Test>
void for_schemes(const std::vector<std::string>& names, const Test& test) {
  for (const auto& [name, scheme] : every_scheme()) {
    const std::string family = name.substr(0, name.find(','));
    if (!names.empty() && std::ranges::find(names, family) == names.end()) continue;
    SCOPED_TRACE(name);
    std::visit(test, scheme);
  }
}
template <class Test>
void for_every_scheme(const Test& test) {
  for_schemes({}, test);
}

template <int Dim>
FaceStencil<Dim, double> stencil_of(const Vec<State<Dim, double>, 4>& w) {
  FaceStencil<Dim, double> cells;
  cells.w = w;
  for (int k = 0; k < 4; ++k) cells.p[k] = pressure<Dim, double>(w[k], gamma_air);
  cells.radius = {{{1.7, 2.1}}};
  return cells;
}

// Face with the area vector's components up to 2, moving at up to half the speed of sound.
template <int Dim>
MovedFace<Dim, double> some_face(Sampler& sample) {
  MovedFace<Dim, double> face;
  face.normal = sample.vector<Dim>(2.0);
  face.sweep = sample.between(-0.6, 0.6) * std::sqrt(dot(face.normal, face.normal));
  return face;
}

template <int Dim, class SchemeType>
State<Dim, double> dissipation(const SchemeType& scheme, const FaceStencil<Dim, double>& cells,
                               const MovedFace<Dim, double>& face,
                               const UniformFlow<Dim, double>& uniform = {}) {
  return scheme.dissipation(cells, face, uniform, gamma_air);
}

// Four cells given by density, velocity and pressure.
inline Vec<State<2, double>, 4> line_of(const Vec<double, 4>& density, const Vec<Vec<double, 2>, 4>& u,
                                        const Vec<double, 4>& p) {
  Vec<State<2, double>, 4> w;
  for (int k = 0; k < 4; ++k) w[k] = conservative<2, double>(density[k], u[k], p[k], gamma_air);
  return w;
}

// What a velocity v added to gas and faces makes of a flux.
template <int Dim>
State<Dim, double> boosted(State<Dim, double> d, const Vec<double, Dim>& v) {
  double work = 0.5 * dot(v, v) * d[0];
  for (int i = 0; i < Dim; ++i) work += v[i] * d[1 + i];
  d[Dim + 1] += work;
  for (int i = 0; i < Dim; ++i) d[1 + i] += v[i] * d[0];
  return d;
}

}  // namespace wingbeat::testing
