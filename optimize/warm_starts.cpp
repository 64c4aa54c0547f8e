#include "optimize/warm_starts.hpp"

#include <algorithm>

#include "core/io/error.hpp"

namespace wingbeat {

void WarmStarts::add(std::span<const double> design, std::vector<double> solution) {
  ensure(design.size() == scales_.size(), "a design of another size");
  std::erase_if(starts_, [&](const Start& start) { return std::ranges::equal(start.design, design); });
  starts_.push_back({{design.begin(), design.end()}, std::move(solution)});
  if (starts_.size() > capacity_) starts_.pop_front();
}

const WarmStarts::Start& WarmStarts::nearest(std::span<const double> design) const {
  ensure(!starts_.empty(), "no solution to start from");
  return *std::ranges::min_element(
      starts_, {}, [&](const Start& start) { return squared_distance(start.design, design); });
}

double WarmStarts::squared_distance(std::span<const double> a, std::span<const double> b) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < scales_.size(); ++i) {
    const double d = (a[i] - b[i]) / scales_[i];
    sum += d * d;
  }
  return sum;
}

}  // namespace wingbeat
