#pragma once

#include <fmt/format.h>

#include <string>

#include "core/mesh/multiblock_mesh.hpp"

// How messages name the parts of a mesh.
namespace wingbeat {

// "i-low" ... "k-high".
inline std::string to_string(const Side& side) {
  return fmt::format("{}-{}", "ijk"[side.direction], side.end == 0 ? "low" : "high");
}

// "(3, 1)": indices counted from 1.
template <int Dim>
std::string index_text(const Index<Dim>& index) {
  std::string text;
  for (int d = 0; d < Dim; ++d) text += fmt::format("{}{}", d == 0 ? "(" : ", ", index[d] + 1);
  return text + ")";
}

inline std::string to_string(BoundaryType type) {
  switch (type) {
    case BoundaryType::slip_wall:
      return "slip wall";
    case BoundaryType::symmetry:
      return "symmetry plane";
    case BoundaryType::farfield:
      return "far field";
  }
  return "unknown";
}

}  // namespace wingbeat
