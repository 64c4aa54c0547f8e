#include "apps/checkpoints.hpp"

#include <algorithm>
#include <utility>

#include "core/io/error.hpp"

namespace wingbeat {

Checkpoints::Checkpoints(const Comm& comm, const StopRequest& stop, const CheckpointSettings& settings,
                         Log& log)
    : comm_(comm), stop_(stop), settings_(settings), log_(log) {
  schedule({});
}

// A checkpoint that took `cost` is followed by none for as long as keeps that within its share.
void Checkpoints::schedule(Clock::duration cost) {
  const std::chrono::duration<double> least = (1.0 / settings_.largest_share - 1.0) * cost;
  const double seconds = std::max(settings_.interval, least.count());
  next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool Checkpoints::goes_on(const std::function<void()>& save) {
  constexpr double nothing = 0.0, checkpoint = 1.0, end = 2.0;
  const bool is_due = settings_.interval > 0.0 && comm_.is_root() && Clock::now() >= next_;
  const double wish = comm_.max(stop_.is_set_here() ? end : is_due ? checkpoint : nothing);
  if (wish == end) return false;
  if (wish == nothing) return true;
  const auto begin = Clock::now();
  try {
    save();
  } catch (const InputError& error) {
    log_.warn(std::string("no checkpoint: ") + error.what());
  }
  schedule(Clock::now() - begin);
  return true;
}

std::optional<SolverMemory> Checkpoints::recall(const std::string& stage) {
  if (!remembers(stage)) return std::nullopt;
  return std::exchange(memory_, std::nullopt);
}

}  // namespace wingbeat
