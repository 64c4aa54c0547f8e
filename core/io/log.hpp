#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace wingbeat {

// What a run tells its user: lines on standard output, also kept in a file. Silent unless
// `speaks` (rank 0 alone does). On a terminal the last line may be a transient status that the
// next line overwrites; in a batch log there are plain lines only.
class Log {
 public:
  explicit Log(bool speaks);
  // Of a run within a run: a file alone is written, which is replaced.
  explicit Log(const std::filesystem::path& file);
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  // From now on lines also go to this file, which is replaced.
  void copy_to(const std::filesystem::path& file);

  void line(std::string_view text);
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    if (speaks_ || file_.is_open()) line(std::string_view(fmt::format(format, std::forward<Args>(args)...)));
  }
  // In the file alone: what few want to read.
  void note(std::string_view text);
  // On standard error and in the file; marked as a warning.
  void warn(std::string_view text);

  // Shows a status on the terminal until the next line; does nothing in a batch log.
  void show_status(std::string_view text);
  void clear_status();
  bool speaks() const { return speaks_; }

 private:
  bool speaks_;
  bool is_live_;
  bool has_status_ = false;
  std::ofstream file_;
};

}  // namespace wingbeat
