#pragma once

#include "core/number/math.hpp"
#include "core/number/vec.hpp"

namespace wingbeat {

// How a reconstruction is held back where a quantity does not vary smoothly from cell to cell.
enum class Limiter { van_albada, venkatakrishnan };

// Differences between cells below this share of the free stream's density, pressure or speed of
// sound count as smooth flow and are left alone. Without it a limiter divides zero by zero in
// uniform flow and answers to the round-off of the far field; set by the size of the differences
// instead of the cells, it does not depend on the unit of length.
inline constexpr double smooth_share = 0.05;

// Van Albada, van Leer and Roberts' average of two differences (Astron. Astrophys. 108, 1982):
// their mean where both are small beside sqrt(e), else nearly the smaller.
template <class T, int N>
Vec<T, N> van_albada_average(const Vec<T, N>& a, const Vec<T, N>& b, double e) {
  const T aa = dot(a, a) + e, bb = dot(b, b) + e;
  const T inverse = 1.0 / (aa + bb);
  return (bb * inverse) * a + (aa * inverse) * b;
}

// Venkatakrishnan's function (doi:10.1006/jcph.1995.1084): the share of an increment that a
// difference to a neighbour allows, 1 at half the difference and where both are small beside
// sqrt(e). Numerator and denominator.
template <class T>
struct Share {
  T numerator;
  T denominator;
};
template <class T, int N>
Share<T> venkatakrishnan_share(const Vec<T, N>& difference, const Vec<T, N>& increment, double e) {
  const T squared = dot(difference, difference) + e, product = dot(difference, increment);
  return {squared + 2.0 * product, squared + product + 2.0 * dot(increment, increment)};
}

// Increment of a quantity from a cell to its face, from the differences behind the cell and across
// the face (eq:limiter). The components of a vector are limited as one, so that the frame does not
// matter. `smooth_squared`: square of a smooth difference. Second order in smooth flow; third
// (kappa = 1/3) where Venkatakrishnan's limiter is at rest.
template <class T, int N>
Vec<T, N> limited_increment(Limiter limiter, const Vec<T, N>& behind, const Vec<T, N>& across,
                            double smooth_squared) {
  if (limiter == Limiter::van_albada) return 0.5 * van_albada_average(behind, across, smooth_squared);
  // Both neighbours have their say: the product of the shares stands, smoothly, for the smaller.
  const Vec<T, N> increment = (1.0 / 6.0) * (behind + 2.0 * across);
  const auto back = venkatakrishnan_share(behind, increment, smooth_squared);
  const auto ahead = venkatakrishnan_share(across, increment, smooth_squared);
  const T share = (back.numerator * ahead.numerator) / (back.denominator * ahead.denominator);
  return share * increment;
}

}  // namespace wingbeat
