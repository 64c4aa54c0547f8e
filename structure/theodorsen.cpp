#include "structure/theodorsen.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/io/error.hpp"
#include "structure/imaginary_unit.hpp"

namespace wingbeat {

namespace {

using Complex = std::complex<double>;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

// K0 and K1 by ascending series, DLMF 10.31.1-2. On |s| <= 2 at most two digits cancel.
struct BesselK {
  Complex k0, k1;
};
BesselK ascending_series(Complex s) {
  const Complex x = 0.25 * s * s;
  const Complex logarithm = std::log(0.5 * s);
  double harmonic = -std::numbers::egamma;  // psi(j + 1)
  Complex power = 1.0;                      // x^j/(j!)^2
  Complex k0 = 0.0;
  Complex k1 = 0.0;
  for (int j = 0; j < 40; ++j) {
    const double next = harmonic + 1.0 / (j + 1);  // psi(j + 2)
    k0 += power * (harmonic - logarithm);
    k1 += power / (j + 1.0) * (logarithm - 0.5 * (harmonic + next));
    if (std::abs(power) < 1e-3 * epsilon * std::abs(k0)) break;
    power *= x / ((j + 1.0) * (j + 1.0));
    harmonic = next;
  }
  return {k0, 1.0 / s + 0.5 * s * k1};
}

// s (K1/K0 - 1) - 1/2 = -h by the continued fraction h = (1/4)/(b_1 + a_2/(b_2 + ...)),
// a_j = -(j - 1/2)^2, b_j = 2 (s + j) (Temme 1975, doi:10.1016/0021-9991(75)90082-0), summed forward
// by the modified Lentz algorithm.
Complex bessel_ratio(Complex s) {
  Complex b = 2.0 * (s + 1.0);
  Complex fraction = b;
  Complex c = b;
  Complex d = 0.0;
  for (int j = 2; j < 2000; ++j) {
    const double a = -(j - 0.5) * (j - 0.5);
    b += 2.0;
    d = 1.0 / (b + a * d);
    c = b + a / c;
    const Complex factor = c * d;
    fraction *= factor;
    if (std::abs(factor - 1.0) < 2.0 * epsilon) return (0.5 + s - 0.25 / fraction) / s;
  }
  ensure(false, fmt::format("K1/K0 did not converge at s = {} + {} i", s.real(), s.imag()));
  return {};
}

}  // namespace

Complex generalised_theodorsen_function(Complex s) {
  if (!std::isfinite(s.real()) || !std::isfinite(s.imag()) || (s.imag() == 0.0 && s.real() < 0.0))
    throw InputError(
        fmt::format("Theodorsen's function at s = {} + {} i: must be finite and off the negative real axis",
                    s.real(), s.imag()));
  if (s == 0.0) return 1.0;
  if (std::abs(s) <= 2.0) {
    const BesselK bessel = ascending_series(s);
    return bessel.k1 / (bessel.k0 + bessel.k1);
  }
  const Complex ratio = bessel_ratio(s);
  return ratio / (1.0 + ratio);
}

Complex theodorsen_function(double k) {
  if (!(k >= 0.0)) throw InputError(fmt::format("reduced frequency k = {}: must be >= 0", k));
  return generalised_theodorsen_function({0.0, k});
}

Eigen::MatrixXcd theodorsen_matrix(double elastic_axis, double k) {
  const double a = elastic_axis;
  const Complex ik = i_unit * k;
  const Complex deficiency = theodorsen_function(k);
  // Downwash at three-quarter chord in units of U, for unit h/b and unit alpha.
  const Eigen::RowVector2cd downwash(ik, 1.0 + ik * (0.5 - a));
  // Apparent mass and the pitch-rate terms that do not pass through the wake.
  const Eigen::RowVector2cd lift = std::numbers::pi * Eigen::RowVector2cd(-k * k, ik + a * k * k) +
                                   2.0 * std::numbers::pi * deficiency * downwash;
  const Eigen::RowVector2cd twice_moment =
      std::numbers::pi * Eigen::RowVector2cd(-a * k * k, -ik * (0.5 - a) + k * k * (0.125 + a * a)) +
      2.0 * std::numbers::pi * (a + 0.5) * deficiency * downwash;
  Eigen::MatrixXcd q(2, 2);
  q << -lift, twice_moment;
  return q;
}

}  // namespace wingbeat
