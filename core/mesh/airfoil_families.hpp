#pragma once

#include <string>

#include "core/mesh/airfoil.hpp"

namespace wingbeat {

// NACA four-digit section, for instance "2412": maximum camber 2 %, at 40 % chord, thickness 12 %.
// The last coefficient of the thickness is -0.1036, which closes the trailing edge. Thickness is
// laid off normal to the camber line. Source: Jacobs, Ward & Pinkerton, NACA Report 460 (1933).
// Throws InputError for zero thickness and for camber without a position (or the reverse).
Airfoil naca_four_digit(const std::string& digits);

// NACA 64A010 from its 26 tabulated ordinates: cubic spline in sqrt(x) with the slope of the nose
// radius 0.00687 at the nose and zero second derivative at the trailing edge, whose half-thickness
// 0.00021 is closed by y - 0.00021 x. Source: Loftin, NACA Report 903 (1948).
Airfoil naca_64a010();

}  // namespace wingbeat
