#include "core/io/log.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace wingbeat {
namespace {

// Open MPI gives every rank a pseudo-terminal, even where mpirun itself writes to a file: what the
// user sees is the standard output of the parent.
bool stdout_is_terminal() {
  if (!std::getenv("OMPI_COMM_WORLD_SIZE")) return ::isatty(STDOUT_FILENO) == 1;
  std::error_code unreadable;
  const std::string target =
      std::filesystem::read_symlink(fmt::format("/proc/{}/fd/1", ::getppid()), unreadable).string();
  return !unreadable && (target.starts_with("/dev/pts/") || target.starts_with("/dev/tty"));
}

}  // namespace

Log::Log(bool speaks) : speaks_(speaks), is_live_(speaks && stdout_is_terminal()) {}

Log::Log(const std::filesystem::path& file) : speaks_(false), is_live_(false), file_(file, std::ios::trunc) {}

Log::~Log() { clear_status(); }

void Log::copy_to(const std::filesystem::path& file) {
  if (speaks_) file_.open(file, std::ios::trunc);
}

void Log::line(std::string_view text) {
  if (speaks_) {
    clear_status();
    fmt::print("{}\n", text);
    // A batch log is read while the run goes on.
    std::fflush(stdout);
  }
  if (file_.is_open()) file_ << text << std::endl;
}

void Log::note(std::string_view text) {
  if (file_.is_open()) file_ << text << std::endl;
}

void Log::warn(std::string_view text) {
  if (speaks_) {
    clear_status();
    fmt::print(stderr, "warning: {}\n", text);
  }
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
