#include "core/parallel/rank_texts.hpp"

namespace wingbeat {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(text.substr(begin, end - begin));
  if (begin < text.size()) lines.push_back(text.substr(begin));
  return lines;
}

std::string joined(const Comm& comm, const std::string& text) {
  std::vector<double> letters(text.begin(), text.end());
  const std::vector<double> all = comm.gather(letters);
  std::string whole;
  for (const double letter : all) whole += static_cast<char>(letter);
  return comm.broadcast(whole);
}

std::string first_line(const Comm& comm, const std::string& text) {
  const auto lines = lines_of(joined(comm, text.empty() ? text : text + "\n"));
  return lines.empty() ? std::string() : lines.front();
}

}  // namespace wingbeat
