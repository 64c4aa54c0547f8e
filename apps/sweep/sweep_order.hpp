#pragma once

#include <optional>
#include <span>
#include <vector>

namespace wingbeat {

// What is known of a point while its sweep runs.
enum class PointState { pending, running, done, failed };

// Places of points (point_places) and which may start from one another: those of one class.
struct PointPlaces {
  std::vector<std::vector<double>> places;  // [point][coordinate]
  std::vector<int> classes;                 // of each point
};

// Which pending point to take next: the nearest to the one done last, so that each continues the one before;
// without one, that farthest from all others begun, so that groups of ranks start apart. The first of equals.
// Nothing where no point is pending.
std::optional<std::size_t> next_point(const PointPlaces& points, std::span<const PointState> states,
                                      std::optional<std::size_t> last);

// The point done that is nearest, of the same class, to start from; nothing where there is none.
std::optional<std::size_t> nearest_done(const PointPlaces& points, std::span<const PointState> states,
                                        std::size_t point);

// Of the other points done, of the same class, one on the line through `point` and `start`, and how far
// beyond `start` the point lies, as a multiple of the distance of both: at most twice, and less than nothing
// between them.
struct PointBefore {
  std::size_t point;
  double ahead;
};
std::optional<PointBefore> done_before(const PointPlaces& points, std::span<const PointState> states,
                                       std::size_t point, std::size_t start);

}  // namespace wingbeat
