#pragma once

#include <span>
#include <string>
#include <string_view>

namespace wingbeat {

// Insertions, deletions, substitutions and swaps of neighbouring characters that turn a into b
// (optimal string alignment), letters compared without case.
int edit_distance(std::string_view a, std::string_view b);

// The name closest to `wrong`, or empty when more than about half of it would have to change.
std::string nearest_name(std::string_view wrong, std::span<const std::string> names);

}  // namespace wingbeat
