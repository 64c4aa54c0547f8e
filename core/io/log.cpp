#include "core/io/log.hpp"

#include <unistd.h>

#include <cstdio>

namespace wingbeat {

Log::Log(bool speaks) : speaks_(speaks), is_live_(speaks && ::isatty(STDOUT_FILENO) == 1) {}

Log::~Log() { clear_status(); }

void Log::copy_to(const std::filesystem::path& file) {
  if (speaks_) file_.open(file, std::ios::trunc);
}

void Log::line(std::string_view text) {
  if (!speaks_) return;
  clear_status();
  fmt::print("{}\n", text);
  // A batch log is read while the run goes on.
  std::fflush(stdout);
  if (file_.is_open()) file_ << text << std::endl;
}

void Log::warn(std::string_view text) {
  if (!speaks_) return;
  clear_status();
  fmt::print(stderr, "warning: {}\n", text);
  if (file_.is_open()) file_ << "warning: " << text << std::endl;
}

void Log::show_status(std::string_view text) {
  if (!is_live_) return;
  fmt::print("\r\033[2K{}", text);
  std::fflush(stdout);
  has_status_ = true;
}

void Log::clear_status() {
  if (!has_status_) return;
  fmt::print("\r\033[2K");
  std::fflush(stdout);
  has_status_ = false;
}

}  // namespace wingbeat
