#pragma once

#include <chrono>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/log.hpp"

namespace wingbeat {

// How far an iteration that reduces `start` to `target` has come, in [0, 1]: the logarithm's share.
double converged_fraction(double start, double now, double target);

// "8.2 s", "3 min 20 s", "2 h 5 min"
std::string duration_text(double seconds);

// A table that grows by a line an iteration or point, each ending with an estimate of the time
// left, and on a terminal a bar below it.
//   Progress progress(log, "flutter", {"iter", "|R|", "|S|", "omega", "V"});
//   progress.row({"1", "3.2e-05", "1.1e-04", "0.6480", "2.8855"}, fraction);
class Progress {
 public:
  Progress(Log& log, std::string title, std::vector<std::string> columns);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // One line, a cell for each column; `fraction` is the share of the work that is done.
  void row(const std::vector<std::string>& cells, double fraction);
  // Moves the bar without a line.
  void show(double fraction);

 private:
  double elapsed() const;
  std::string time_left(double fraction) const;

  Log& log_;
  std::string title_;
  std::vector<std::string> columns_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace wingbeat
