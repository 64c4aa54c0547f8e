#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/spectral/time_spectral.hpp"

namespace wingbeat {

// Mean over the instances of a field [instance][width].
inline std::vector<double> mean_instance(std::span<const double> field, const TimeSpectral& time) {
  const auto instances = static_cast<std::size_t>(time.instances()), width = field.size() / instances;
  std::vector<double> mean(width, 0.0);
  for (std::size_t i = 0; i < field.size(); ++i) mean[i % width] += field[i] / static_cast<double>(instances);
  return mean;
}

}  // namespace wingbeat
