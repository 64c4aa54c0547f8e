#pragma once

#include "core/number/math.hpp"
#include "core/number/vec.hpp"

// Perfect gas in the code's units: chord 1, rho_inf = 1, p_inf = 1.
namespace wingbeat {

template <int Dim>
inline constexpr int state_size = Dim + 2;

// Conservative state w = (rho, rho u, rho E).
template <int Dim, class T>
using State = Vec<T, state_size<Dim>>;

// p = (gamma - 1) (rho E - |rho u|^2 / (2 rho))  (eq:gas)
template <int Dim, class T>
T pressure(const State<Dim, T>& w, double gamma) {
  T momentum_squared = w[1] * w[1];
  for (int d = 1; d < Dim; ++d) momentum_squared += w[1 + d] * w[1 + d];
  return (gamma - 1.0) * (w[Dim + 1] - 0.5 * momentum_squared / w[0]);
}

template <int Dim, class T>
Vec<T, Dim> velocity(const Vec<T, Dim + 2>& w) {
  Vec<T, Dim> u;
  const T inverse_density = T(1.0) / w[0];
  for (int d = 0; d < Dim; ++d) u[d] = w[1 + d] * inverse_density;
  return u;
}

template <int Dim, class T>
State<Dim, T> conservative(const T& density, const Vec<T, Dim>& u, const T& p, double gamma) {
  State<Dim, T> w;
  w[0] = density;
  for (int d = 0; d < Dim; ++d) w[1 + d] = density * u[d];
  w[Dim + 1] = p / (gamma - 1.0) + 0.5 * density * dot(u, u);
  return w;
}

// Flux of w through a face of area vector `normal` that sweeps the volume rate `sweep`:
//   F = w (u . n - sweep) + (0, p n, p u . n)  (eq:euler-ale)
// The number type G of the geometry may be simpler than the state's: constants carry no gradient.
template <int Dim, class T, class G>
State<Dim, T> euler_flux(const Vec<T, Dim + 2>& w, const T& p, const Vec<G, Dim>& normal, const G& sweep) {
  const T through = dot(velocity<Dim>(w), normal);
  State<Dim, T> flux = (through - sweep) * w;
  for (int d = 0; d < Dim; ++d) flux[1 + d] += p * normal[d];
  flux[Dim + 1] += p * through;
  return flux;
}

// A uniform flow that fluxes may be taken in excess of.
template <int Dim, class T>
struct UniformFlow {
  State<Dim, T> w{};
  Vec<T, Dim> u{};
  T p{};
};

// Flux in excess of that of a uniform flow through the same face (eq:excess-flux). Over a closed
// cell the uniform flow's fluxes cancel, whatever its motion; leaving them out scales round-off
// with the disturbance, which in the large cells of the far field is orders smaller than the flow.
template <int Dim, class T>
State<Dim, T> excess_flux(const State<Dim, T>& w, const T& p, const UniformFlow<Dim, T>& uniform,
                          const Vec<T, Dim>& normal, const T& sweep) {
  const Vec<T, Dim> u = velocity<Dim>(w);
  const T through = dot(u, normal);
  const T excess = dot(u - uniform.u, normal);
  State<Dim, T> flux = (through - sweep) * (w - uniform.w) + excess * uniform.w;
  for (int d = 0; d < Dim; ++d) flux[1 + d] += (p - uniform.p) * normal[d];
  flux[Dim + 1] += (p - uniform.p) * through + uniform.p * excess;
  return flux;
}

// The undisturbed flow: p = rho = 1, speed U = M sqrt(gamma) at `angle` (radians, nose up).
template <int Dim, class T>
struct Freestream {
  double gamma = 1.4;
  T mach{};
  T angle_cosine = T(1.0);
  T angle_sine{};

  T speed() const { return mach * std::sqrt(gamma); }
  Vec<T, Dim> velocity() const {
    Vec<T, Dim> u;
    u[0] = speed() * angle_cosine;
    u[1] = speed() * angle_sine;
    return u;
  }
  State<Dim, T> state() const { return conservative<Dim, T>(T(1.0), velocity(), T(1.0), gamma); }
  UniformFlow<Dim, T> flow() const { return {state(), velocity(), T(1.0)}; }
  T dynamic_pressure() const { return 0.5 * gamma * mach * mach; }
};

}  // namespace wingbeat
