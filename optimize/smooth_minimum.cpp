#include "optimize/smooth_minimum.hpp"

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {

SmoothMinimum smooth_minimum(std::span<const double> values, double sharpness, double reference) {
  ensure(!values.empty() && sharpness > 0.0 && reference > 0.0,
         "a smooth minimum needs numbers, a positive sharpness and a positive reference");
  // Exponents are taken from the least number on: the largest is then 0.
  const double least = *std::ranges::min_element(values);
  SmoothMinimum result;
  double sum = 0.0;
  for (const double value : values) {
    result.derivatives.push_back(std::exp(-sharpness * (value - least) / reference));
    sum += result.derivatives.back();
  }
  for (double& derivative : result.derivatives) derivative /= sum;
  result.value = least - reference / sharpness * std::log(sum);
  return result;
}

}  // namespace wingbeat
