#include "test/apps/mutation.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

namespace wingbeat {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  if (lines.empty()) lines.emplace_back();
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text.append(line).append("\n");
  return text;
}

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

// The part so many times, between a beginning and an end.
std::string enclosed(const char* begin, const char* part, int times, const char* end) {
  std::string text(begin);
  text.append(repeated(part, times));
  text.append(end);
  return text;
}

const std::vector<std::string>& hostile_values() {
  static const std::vector<std::string> values{
      "nan",
      "-nan",
      "inf",
      "-inf",
      "0",
      "-0.0",
      "-1",
      "1",
      "2",
      "1e308",
      "-1e308",
      "1e400",
      "1e-320",
      "0.999999999999999999",
      "16384",
      "65536",
      "2147483647",
      "2147483648",
      "-2147483649",
      "9223372036854775807",
      "-9223372036854775808",
      "99999999999999999999999",
      "0x7fffffff",
      "1_0_0",
      "true",
      "\"\"",
      "\"\\u0000\"",
      "\"\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\"",
      "\"\xff\xfe\"",
      "\"naca64a010\"",
      "\"naca0000\"",
      "\"naca9999\"",
      "\"naca4412\"",
      "\"/dev/zero\"",
      "\"/\"",
      "\"case.toml\"",
      "\"..\"",
      "\"newton\"",
      "\"steady.cl\"",
      "\"2 * steady.cd + * 1\"",
      "[]",
      "[[]]",
      "[nan, nan]",
      "[1e308, -1e308]",
      "[16384, 16384]",
      "[16, 4]",
      "[4, 4]",
      "[1, 2, 3, 4, 5, 6, 7, 8, 9, 10]",
      "[\"\", \"a\"]",
      "[\"steady.cl > 0\", \"x\"]",
      "[1, \"a\", true]",
      "{}",
      "{a = 1}",
      "{a = {b = {c = 1}}}",
      "1979-05-27T07:32:00Z",
      "'''",
      "\"\"\"",
      "[1,",
      "",
      "= =",
      repeated("[", 1000),
      enclosed("", "{a=", 300, "1"),
      enclosed("\"", "x", 100000, "\""),
      repeated("9", 5000),
      enclosed("[", "1, ", 20000, "1]"),
  };
  return values;
}

const std::vector<std::string>& hostile_lines() {
  static const std::vector<std::string> lines{"[mesh]",
                                              "[[mesh]]",
                                              "[mesh.cells]",
                                              "[a.b.c]",
                                              "[]",
                                              "[",
                                              "]",
                                              "mesh = 1",
                                              "mesh.cells = [32, 8]",
                                              "cells = [32, 8]",
                                              "\"\" = 1",
                                              "\"a\\nb\" = 1",
                                              "a.b.c.d = 1",
                                              "# \xff\xfe",
                                              "\t",
                                              std::string(1, '\0'),
                                              "\xef\xbb\xbf",
                                              "\r",
                                              enclosed("", "a.", 500, "a = 1"),
                                              enclosed("[", "a.", 500, "a]"),
                                              repeated("#", 100000)};
  return lines;
}

}  // namespace

std::size_t Mutation::below(std::size_t count) {
  // Not std::uniform_int_distribution, whose numbers are the library's own affair.
  return static_cast<std::size_t>(random_() % count);
}

std::string Mutation::value() {
  if (below(4) != 0) return one_of(hostile_values());
  const double magnitude = static_cast<double>(below(2000)) - 1000.0;
  return below(2) == 0 ? std::to_string(static_cast<long>(magnitude)) : std::to_string(magnitude / 100.0);
}

std::string Mutation::of_case(const std::vector<std::string>& texts) {
  std::string text = one_of(texts);
  const std::size_t faults = 1 + below(4);
  for (std::size_t i = 0; i < faults; ++i) damage_case(text, texts);
  return text;
}

void Mutation::damage_case(std::string& text, const std::vector<std::string>& texts) {
  const std::size_t kind = below(12);
  if (kind == 0) return damage_bytes(text, text.size());
  std::vector<std::string> lines = lines_of(text);
  std::string& line = lines[below(lines.size())];
  const auto place = lines.begin() + static_cast<std::ptrdiff_t>(below(lines.size()));
  const std::size_t equals = line.find('=');
  switch (kind) {
    case 1:
      lines.erase(place);
      break;
    case 2:
      lines.insert(place, std::string(line));
      break;
    case 3:
      std::swap(line, *place);
      break;
    case 4:
      lines.insert(place, one_of(lines_of(one_of(texts))));
      break;
    case 5:
      lines.insert(place, one_of(hostile_lines()));
      break;
    case 6:
      if (equals != std::string::npos && equals > 0)
        line.insert(below(equals), 1, static_cast<char>(32 + below(96)));
      break;
    default:  // the commonest: a value, of which the checks are to be told
      if (equals == std::string::npos) break;
      line.resize(equals);
      line.append("= ").append(value());
  }
  text = joined(lines);
}

std::string Mutation::of_bytes(std::string bytes, std::size_t head) {
  const std::size_t faults = 1 + below(4);
  for (std::size_t i = 0; i < faults; ++i) damage_bytes(bytes, below(2) == 0 ? head : bytes.size());
  return bytes;
}

void Mutation::damage_bytes(std::string& bytes, std::size_t head) {
  if (bytes.empty()) return;
  const std::size_t at = below(std::max<std::size_t>(1, std::min(head, bytes.size())));
  const std::size_t length = std::min(bytes.size() - at, 1 + below(below(4) == 0 ? 512 : 8));
  switch (below(8)) {
    case 0:
      bytes.resize(at);
      break;
    case 1:
      bytes.erase(at, length);
      break;
    case 2:
      bytes.insert(at, bytes.substr(below(bytes.size()), length));
      break;
    case 3:
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\0');
      break;
    case 4:
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\xff');
      break;
    case 5:
      for (std::size_t i = 0; i < length; ++i) bytes[at + i] = static_cast<char>(below(256));
      break;
    default:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
  }
}

}  // namespace wingbeat
