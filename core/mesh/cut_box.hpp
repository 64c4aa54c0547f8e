#pragma once

#include <cstddef>
#include <vector>

#include "core/mesh/block_array.hpp"

namespace wingbeat {

// How many pieces of `minimum_width` fit into a box.
template <int Dim>
std::size_t cut_capacity(const Box<Dim>& box, int minimum_width);

// Cuts `box` into `count` boxes of nearly equal size that cover it exactly, by repeated halving:
// in the first direction long enough for all the pieces to be `minimum_width` wide, else in the
// longest. Throws InputError if `count` pieces of that width do not fit.
template <int Dim>
std::vector<Box<Dim>> cut_box(const Box<Dim>& box, int count, int minimum_width = 1);

}  // namespace wingbeat
