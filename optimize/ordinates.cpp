#include "optimize/ordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/io/error.hpp"
#include "core/io/file.hpp"

namespace wingbeat {

void write_ordinates(const std::filesystem::path& path, const std::string& title,
                     std::span<const Vec<double, 2>> wall) {
  ensure(!wall.empty(), "a wall without nodes has no ordinates");
  std::string line = title;
  std::ranges::replace_if(
      line, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  // A comment rather than a plain title: one that begins with a number would be taken for a point.
  std::string text = fmt::format("# {}\n", line);
  const auto add = [&](const Vec<double, 2>& point) {
    fmt::format_to(std::back_inserter(text), "{:.17g} {:.17g}\n", point[0], point[1]);
  };
  add(wall.front());
  for (std::size_t w = wall.size(); w-- > 0;) add(wall[w]);
  write_file(path, text);
}

}  // namespace wingbeat
