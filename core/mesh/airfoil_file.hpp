#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "core/mesh/airfoil.hpp"

namespace wingbeat {

// Section from a file of ordinates: "x y" a line, in Selig order (upper trailing edge, leading edge,
// lower trailing edge) or its reverse; '#' starts a comment, the first line may be a title.
//
// Coordinates are chords: the trailing edge lies at x = 1 within 1 %, the foremost ordinate at x = 0 within
// 5 %, and neither is moved. An open trailing edge of up to 1 % chord is closed by a shear proportional to x, which moves
// both ends to their midpoint. The points are interpolated by not-a-knot cubic splines x(t), y(t)
// with t = +-sqrt(distance in x behind the vertex of the nose), so that the nose radius is finite.
//
// Throws InputError naming file:line for numbers that are missing, unreadable or not finite, fewer
// than 10 points, repeated points, another order of points, and a surface that crosses itself.
Airfoil read_airfoil(const std::filesystem::path& path);

// The same from a stream; `name` stands for the file in messages.
Airfoil read_airfoil(std::istream& input, const std::string& name);

}  // namespace wingbeat
