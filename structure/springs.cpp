#include "structure/springs.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

void require_positive(double value, const char* what) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw InputError(fmt::format("freeplay spring: the {} is {}; it must be a number > 0", what, value));
}

// ln cosh x + ln 2, without overflow.
double softened_abs(double x) { return std::abs(x) + std::log1p(std::exp(-2.0 * std::abs(x))); }

}  // namespace

RestoringForce polynomial_spring(int mode, double cubic, double quintic) {
  return {mode, [=](double u) { return u * u * u * (cubic + quintic * u * u); },
          [=](double u) { return u * u * (3.0 * cubic + 5.0 * quintic * u * u); }};
}

RestoringForce freeplay_spring(int mode, double stiffness, double gap, double smoothing) {
  require_positive(gap, "gap");
  require_positive(smoothing, "smoothing");
  const double width = smoothing * gap;
  return {mode,
          [=](double u) {
            return -0.5 * stiffness * width *
                   (softened_abs((u + gap) / width) - softened_abs((u - gap) / width));
          },
          [=](double u) {
            return -0.5 * stiffness * (std::tanh((u + gap) / width) - std::tanh((u - gap) / width));
          }};
}

}  // namespace wingbeat
