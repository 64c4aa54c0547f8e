#pragma once

#include <span>

namespace wingbeat {

// Largest step in (0, 1] for which w + step dw changes no density or pressure, to first order, by
// more than the fraction `limit`. Of this rank's cells: not collective.
template <int Dim>
double largest_step(std::span<const double> w, std::span<const double> dw, double gamma, double limit);

}  // namespace wingbeat
