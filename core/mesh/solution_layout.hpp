#pragma once

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>

#include "core/mesh/solution_file.hpp"

// Names and layout that the writing and the reading of solution files share.
namespace wingbeat::solution_layout {

using Name = std::array<char, 33>;
inline constexpr std::size_t name_length = 32;
inline constexpr const char* restart_node = "RestartData";
inline constexpr const char* format_name = "format";
inline constexpr const char* sum_name = "sum";
inline constexpr double format = 1.0;  // a file without this number is of an earlier version

inline std::string flow_name(std::size_t instance) { return fmt::format("FlowSolution{}", instance + 1); }
inline std::string grid_name(std::size_t instance) { return fmt::format("GridCoordinates{}", instance + 1); }
inline std::string coordinate_name(int c) { return fmt::format("Coordinate{}", "XYZ"[c]); }

// FNV-1a over 64-bit words (Fowler, Noll, Vo): changes with any bit.
class Sum {
 public:
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::span<const double> values) {
    for (const double value : values) add(value);
  }
  void add(const std::string& text) {
    for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }
  std::string text() const { return fmt::format("{:016x}", sum_); }

 private:
  void add(std::uint64_t word) {
    sum_ ^= word;
    sum_ *= 0x100000001b3u;
    sum_ ^= sum_ >> 32;  // high bits of a word reach all of the sum
  }
  std::uint64_t sum_ = 0xcbf29ce484222325u;
};

// Of everything that a restart takes from the file. Nodes follow from the mesh and the motion.
template <int Dim>
std::string sum_of(const Solution<Dim>& solution) {
  Sum sum;
  for (const auto& instance : solution.instances) {
    sum.add(instance.time);
    for (const auto& zone : instance.zones)
      for (const SolutionField& field : zone.fields) sum.add(std::span<const double>(field.values));
  }
  for (const auto& [name, values] : solution.data) {
    sum.add(name);
    sum.add(std::span<const double>(values));
  }
  for (const auto& [name, text] : solution.text) {
    sum.add(name);
    sum.add(text);
  }
  return sum.text();
}

}  // namespace wingbeat::solution_layout
