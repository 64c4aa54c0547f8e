#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "apps/sweep/sweep_order.hpp"
#include "core/parallel/shared_board.hpp"

namespace wingbeat {

// The points of a sweep, shared out to groups of ranks, whose first ranks call. Construction and destruction
// are collective over all ranks, nothing else is.
class SweepQueue {
 public:
  // `states`: pending, done or failed, as known to rank 0.
  SweepQueue(const Comm& world, PointPlaces points, const std::vector<PointState>& states);

  // The next point, from now on running, and those done that it should start from. Nothing when none is
  // pending or a group has called stop().
  struct Task {
    std::size_t point = 0;
    std::optional<std::size_t> start{};
    std::optional<PointBefore> before{};
  };
  std::optional<Task> take(std::optional<std::size_t> last,
                           const std::function<void(std::size_t point)>& record_begin);
  // The point is done or has failed; pending: it is given back. `record` runs while no other group has the
  // queue.
  void finish(std::size_t point, PointState state, const std::function<void()>& record);
  void stop();
  // This group takes no more points.
  void leave();

  struct Count {
    int done = 0, failed = 0, left = 0, groups = 0;  // groups: that have left
  };
  Count count();
  std::vector<PointState> states();

 private:
  using Board = std::span<long>;
  static std::vector<PointState> states_on(Board board);

  PointPlaces points_;
  SharedBoard board_;  // a state a point; whether to stop; how many groups have left
};

}  // namespace wingbeat
