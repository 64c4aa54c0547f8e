#include "optimize/wall_limits.hpp"

#include <cmath>

namespace wingbeat {

std::vector<LinearLimit> wall_limits(const SectionWall& wall, const HicksHenne& bumps, double bound,
                                     double least) {
  const auto variables = static_cast<std::size_t>(bumps.variables());
  std::vector<LinearLimit> limits(wall.size());
  for (LinearLimit& limit : limits) limit = {std::vector<double>(variables), least - 1.0};
  for (std::size_t v = 0; v < variables; ++v) {
    std::vector<double> unit(variables, 0.0);
    unit[v] = 1.0;
    const std::vector<Vec<double, 2>> moved = bumps.displacement(unit);
    for (std::size_t i = 0; i < wall.size(); ++i) {
      const std::size_t next = (i + 1) % wall.size();
      const Vec<double, 2> face = wall.positions[next] - wall.positions[i];
      limits[i].coefficients[v] = dot(moved[next] - moved[i], face) / dot(face, face);
    }
  }
  std::erase_if(limits, [&](const LinearLimit& limit) {
    double worst = 0.0;
    for (const double c : limit.coefficients) worst -= std::abs(c) * bound;
    return worst >= limit.lower;
  });
  return limits;
}

}  // namespace wingbeat
