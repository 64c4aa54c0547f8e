#include "apps/timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace wingbeat {

std::vector<PartTiming> gather_timings(const Comm& comm, const Timer& timer) {
  const auto parts = timer.parts();
  // Rank 0 says which parts there are: another rank may have skipped some.
  std::string listing;
  for (const auto& part : parts) listing += fmt::format("{} {} {}\n", part.depth, part.count, part.path);
  std::istringstream lines(comm.broadcast(listing));

  const auto over_ranks = [&](PartTiming timing, double seconds) {
    timing.minimum = comm.min(seconds);
    timing.mean = comm.sum(seconds) / comm.size();
    timing.maximum = comm.max(seconds);
    return timing;
  };
  std::vector<PartTiming> timings{over_ranks({.path = "total", .depth = 0, .count = 1}, timer.elapsed())};
  PartTiming timing;
  while (lines >> timing.depth >> timing.count && std::getline(lines >> std::ws, timing.path)) {
    const auto own = std::ranges::find(parts, timing.path, &Timer::Part::path);
    timings.push_back(over_ranks(timing, own == parts.end() ? 0.0 : own->seconds));
  }
  return timings;
}

std::string timing_table(const std::vector<PartTiming>& timings) {
  std::string text = fmt::format("{:<32} {:>9} {:>9} {:>9} {:>7}\n", "seconds over the ranks", "min", "mean",
                                 "max", "times");
  for (const auto& timing : timings) {
    const auto name = timing.path.substr(timing.path.rfind('/') + 1);
    text +=
        fmt::format("{:<32} {:>9.3f} {:>9.3f} {:>9.3f} {:>7}\n", std::string(2 * timing.depth, ' ') + name,
                    timing.minimum, timing.mean, timing.maximum, timing.count);
  }
  text.pop_back();
  return text;
}

}  // namespace wingbeat
