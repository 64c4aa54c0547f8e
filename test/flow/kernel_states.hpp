#pragma once

#include <cmath>
#include <random>

#include "flow/boundary.hpp"
#include "flow/cell_quantities.hpp"
#include "flow/scheme/scheme.hpp"

namespace wingbeat::testing {

inline constexpr double gamma_air = 1.4;

// Reproducible physical states, area vectors and rotations.
class Sampler {
 public:
  explicit Sampler(unsigned seed) : generator_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }

  template <int Dim>
  Vec<double, Dim> vector(double size) {
    Vec<double, Dim> v;
    for (int d = 0; d < Dim; ++d) v[d] = between(-size, size);
    return v;
  }
  // Mach numbers up to 1.5.
  template <int Dim>
  State<Dim, double> state() {
    return near<Dim>(between(0.6, 1.5), vector<Dim>(1.0), between(0.6, 1.5), 0.0);
  }
  // Four cells in line that differ by about `spread`.
  template <int Dim>
  Vec<State<Dim, double>, 4> line(double spread) {
    const double density = between(0.6, 1.5), p = between(0.6, 1.5);
    const Vec<double, Dim> u = vector<Dim>(1.0);
    Vec<State<Dim, double>, 4> cells;
    for (int k = 0; k < 4; ++k) cells[k] = near<Dim>(density, u, p, spread);
    return cells;
  }

 private:
  template <int Dim>
  State<Dim, double> near(double density, const Vec<double, Dim>& u, double p, double spread) {
    const double rho = density * (1.0 + between(-spread, spread)), q = p * (1.0 + between(-spread, spread));
    return conservative<Dim, double>(rho, u + vector<Dim>(spread), q, gamma_air);
  }

  std::mt19937_64 generator_;
};

// Turns vectors about z, and in 3-D then about x.
template <int Dim>
struct Rotation {
  double first = 0.7;
  double second = -1.1;

  Vec<double, Dim> operator()(const Vec<double, Dim>& v) const {
    Vec<double, Dim> turned = v;
    turned[0] = std::cos(first) * v[0] - std::sin(first) * v[1];
    turned[1] = std::sin(first) * v[0] + std::cos(first) * v[1];
    if constexpr (Dim == 3) {
      const double y = turned[1], z = turned[2];
      turned[1] = std::cos(second) * y - std::sin(second) * z;
      turned[2] = std::sin(second) * y + std::cos(second) * z;
    }
    return turned;
  }
  // The momentum of a state, or the momentum rows of a flux.
  State<Dim, double> of_state(State<Dim, double> w) const {
    Vec<double, Dim> momentum;
    for (int d = 0; d < Dim; ++d) momentum[d] = w[1 + d];
    momentum = (*this)(momentum);
    for (int d = 0; d < Dim; ++d) w[1 + d] = momentum[d];
    return w;
  }
};

// The whole flux through a face as a function of its four cells alone: pressures and scaled radii
// follow from the states. Normals of the cell's directions, the face's first.
template <int Dim, class T, class SchemeType>
State<Dim, T> flux_of_cells(const Vec<State<Dim, T>, 4>& w, const Vec<Vec<double, Dim>, Dim>& normals,
                                const Vec<double, Dim>& sweeps, const SchemeType& scheme) {
  FaceStencil<Dim, T> cells;
  for (int k = 0; k < 4; ++k) {
    cells.w[k] = w[k];
    cells.p[k] = pressure<Dim, T>(w[k], gamma_air);
  }
  for (int k = 0; k < 2; ++k)
    cells.radius[k] = scaled_radii<Dim, T>(
        spectral_radii<Dim, T, double>(w[1 + k], cells.p[1 + k], normals, sweeps, gamma_air))[0];
  Vec<T, Dim> normal;
  for (int d = 0; d < Dim; ++d) normal[d] = T(normals[0][d]);
  return numerical_flux<Dim, T>(scheme, cells, MovedFace<Dim, T>{normal, T(sweeps[0])}, gamma_air);
}

// Three independent directions of a cell of aspect ratio up to `stretch`.
template <int Dim>
Vec<Vec<double, Dim>, Dim> cell_normals(Sampler& sample, double stretch) {
  Vec<Vec<double, Dim>, Dim> normals;
  for (int d = 0; d < Dim; ++d) {
    normals[d] = sample.vector<Dim>(0.3);
    normals[d][d] += d == 0 ? stretch : 1.0;
  }
  return normals;
}

}  // namespace wingbeat::testing
