#include "core/io/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

constexpr std::size_t column_width = 11;

std::string table_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const auto& cell : cells) line += fmt::format(" {:>{}}", cell, column_width);
  return line;
}

}  // namespace

double converged_fraction(double start, double now, double target) {
  if (now <= target) return 1.0;
  if (!(start > target) || !(now < start)) return 0.0;
  return std::log(start / now) / std::log(start / target);
}

std::string duration_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(Log& log, std::string title, std::vector<std::string> columns)
    : log_(log),
      title_(std::move(title)),
      columns_(std::move(columns)),
      start_(std::chrono::steady_clock::now()) {
  std::vector<std::string> head = columns_;
  head.push_back("time left");
  log_.line(title_);
  log_.line(table_line(head));
}

Progress::~Progress() { log_.clear_status(); }

double Progress::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

std::string Progress::time_left(double fraction) const {
  if (fraction >= 1.0) return "-";
  if (!(fraction > 0.0)) return "?";
  return duration_text(elapsed() * (1.0 - fraction) / fraction);
}

void Progress::row(const std::vector<std::string>& cells, double fraction) {
  ensure(cells.size() == columns_.size(), "a progress row needs a cell for each column");
  std::vector<std::string> line = cells;
  line.push_back(time_left(fraction));
  log_.line(table_line(line));
  if (fraction < 1.0) show(fraction);
}

void Progress::show(double fraction) {
  constexpr int width = 30;
  const int filled = static_cast<int>(std::lround(width * std::clamp(fraction, 0.0, 1.0)));
  log_.show_status(fmt::format("{} [{:#<{}}{:.<{}}] {:.0f} %, {} left", title_, "", filled, "",
                               width - filled, 100.0 * fraction, time_left(fraction)));
}

}  // namespace wingbeat
