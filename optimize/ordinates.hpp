#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/number/vec.hpp"

namespace wingbeat {

// Writes a section as a file of ordinates that read_airfoil (mesh.airfoil) reads: the title as a comment,
// then "x y" a line with 17 significant digits, from the trailing edge over the upper surface, the leading
// edge and the lower surface back to the trailing edge. `wall` in the order of SectionWall, in chords.
void write_ordinates(const std::filesystem::path& path, const std::string& title,
                     std::span<const Vec<double, 2>> wall);

}  // namespace wingbeat
