#pragma once

#include <limits>

#include "flow/moved_face.hpp"
#include "flow/scheme/muscl.hpp"

namespace wingbeat {

// A face by its area, unit normal and normal speed. A face without area has no normal and lets
// nothing through.
template <int Dim, class T>
struct UnitFace {
  T area;
  Vec<T, Dim> normal;
  T speed;
};
template <int Dim, class T>
UnitFace<Dim, T> unit_face(const MovedFace<Dim, T>& face) {
  const T area = sqrt(max<T>(dot(face.normal, face.normal), T(std::numeric_limits<double>::min())));
  const T inverse = 1.0 / area;
  return {area, inverse * face.normal, inverse * face.sweep};
}

// The state that a flux Jacobian is taken at.
template <int Dim, class T>
struct MeanFlow {
  Vec<T, Dim> u;
  T enthalpy;  // total, per unit mass
  T sound_speed_squared;
};

// Means weighted by the square root of density, at which the Jacobian maps the jump of states to
// that of fluxes (eq:roe-average; P. L. Roe, doi:10.1016/0021-9991(81)90128-5).
template <int Dim, class T>
MeanFlow<Dim, T> roe_average(const GasState<Dim, T>& left, const GasState<Dim, T>& right, double gamma) {
  const double g = gamma / (gamma - 1.0);
  const T ratio = sqrt(right.density / left.density);
  const T share_left = 1.0 / (1.0 + ratio), share_right = ratio * share_left;
  const auto enthalpy = [&](const GasState<Dim, T>& side) {
    return g * side.p / side.density + 0.5 * dot(side.u, side.u);
  };
  MeanFlow<Dim, T> mean;
  mean.u = share_left * left.u + share_right * right.u;
  mean.enthalpy = share_left * enthalpy(left) + share_right * enthalpy(right);
  mean.sound_speed_squared = (gamma - 1.0) * (mean.enthalpy - 0.5 * dot(mean.u, mean.u));
  return mean;
}

// |x| rounded off below twice `floor`, which it does not fall under (A. Harten's correction,
// doi:10.1016/0021-9991(83)90136-5).
template <class T>
T floored_abs(const T& x, const T& floor) {
  const T size = abs(x);
  return select(size < 2.0 * floor, x * x / (4.0 * floor) + floor, size);
}

// Moduli of the waves' speeds through a face: entropy and shear, and the acoustic waves that run
// against and along its normal.
template <class T>
struct WaveSpeeds {
  T linear;
  T against;
  T along;
};

// |A| dw per unit area, A the Jacobian of the flux through the face with its eigenvalues' moduli
// given, without a matrix (eq:absolute-jacobian): all waves travel at `linear`, then the acoustic
// ones, known by their pressure and normal momentum, get what they differ by.
template <int Dim, class T>
State<Dim, T> absolute_jacobian(const MeanFlow<Dim, T>& mean, const T& sound_speed, const Vec<T, Dim>& normal,
                                const WaveSpeeds<T>& speeds, const State<Dim, T>& dw, double gamma) {
  const T u_normal = dot(mean.u, normal);
  T momentum = -u_normal * dw[0];  // normal, in excess of what density carries
  T work = dw[Dim + 1] + 0.5 * dot(mean.u, mean.u) * dw[0];
  for (int d = 0; d < Dim; ++d) {
    momentum += normal[d] * dw[1 + d];
    work -= mean.u[d] * dw[1 + d];
  }
  const T dp = (gamma - 1.0) * work;
  const T mean_speed = 0.5 * (speeds.along + speeds.against) - speeds.linear;
  const T difference = 0.5 * (speeds.along - speeds.against) / sound_speed;
  const T carried = mean_speed * dp / mean.sound_speed_squared + difference * momentum;
  const T pushed = mean_speed * momentum + difference * dp;

  State<Dim, T> result = speeds.linear * dw;
  result[0] += carried;
  for (int d = 0; d < Dim; ++d) result[1 + d] += carried * mean.u[d] + pushed * normal[d];
  result[Dim + 1] += carried * mean.enthalpy + pushed * u_normal;
  return result;
}

}  // namespace wingbeat
