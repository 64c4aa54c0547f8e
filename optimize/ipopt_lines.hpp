#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace wingbeat {

// Hands text that comes in pieces on line by line.
class LineSplitter {
 public:
  explicit LineSplitter(std::function<void(std::string_view)> print_line)
      : print_line_(std::move(print_line)) {}

  void add(std::string_view text) {
    for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
      line_ += text.substr(0, end);
      print_line_(std::exchange(line_, {}));
      text.remove_prefix(end + 1);
    }
    line_ += text;
  }
  // The last line, where no newline ended it.
  void finish() {
    if (!line_.empty()) print_line_(std::exchange(line_, {}));
  }

 private:
  std::function<void(std::string_view)> print_line_;
  std::string line_;
};

}  // namespace wingbeat
