#include "structure/staggered_energy_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

constexpr double largest_factor = 4.0;
constexpr double first_factor = 1.5;  // a second point, far enough to give a slope

}  // namespace

EnergySearch::EnergySearch(double target_r, double initial_energy, std::optional<Point> last)
    : target_(target_r), energy_(initial_energy), last_(last) {
  if (!(target_r > 0.0) || !std::isfinite(target_r))
    throw InputError(
        fmt::format("limit cycle at freestream parameter r = {}: must be a number > 0", target_r));
  if (!(initial_energy > 0.0) || !std::isfinite(initial_energy))
    throw InputError(fmt::format("initial energy {} of a limit cycle: must be a number > 0", initial_energy));
}

void EnergySearch::advance(double r) {
  const Point here{energy_, mismatch(r)};
  // Without a slope: most branches rise from the boundary.
  double next = here.mismatch < 0.0 ? here.energy * first_factor : here.energy / first_factor;
  if (last_) {
    const double change = here.mismatch - last_->mismatch;
    if (change != 0.0) next = here.energy - here.mismatch * (here.energy - last_->energy) / change;
  }
  if (std::isfinite(next))
    energy_ = std::clamp(next, here.energy / largest_factor, here.energy * largest_factor);
  last_ = here;
}

}  // namespace wingbeat
