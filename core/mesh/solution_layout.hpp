#pragma once

#include <fmt/format.h>

#include <array>
#include <string>

// Names and layout that the writing and the reading of solution files share.
namespace wingbeat::solution_layout {

using Name = std::array<char, 33>;
inline constexpr std::size_t name_length = 32;
inline constexpr const char* restart_node = "RestartData";

inline std::string flow_name(std::size_t instance) { return fmt::format("FlowSolution{}", instance + 1); }
inline std::string grid_name(std::size_t instance) { return fmt::format("GridCoordinates{}", instance + 1); }
inline std::string coordinate_name(int c) { return fmt::format("Coordinate{}", "XYZ"[c]); }

}  // namespace wingbeat::solution_layout
