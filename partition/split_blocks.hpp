#pragma once

#include <utility>
#include <vector>

#include "partition/partition.hpp"

namespace wingbeat {

// Where to cut a range of cells so that about `share` (between 0 and 1) of it lies below: an
// exact division is taken as it is, else the even one of the two nearest planes, for multigrid.
int cut_plane(int begin, int end, double share);

// The box in two along direction d, the first ending at plane `cut`.
template <int Dim>
std::pair<Box<Dim>, Box<Dim>> cut_at(const Box<Dim>& box, int d, int cut);

// Directions of the box, the longest first.
template <int Dim>
Index<Dim> directions_by_extent(const Box<Dim>& box);

// The box in `pieces` boxes of nearly equal size (fewer where it has fewer cells), by recursive
// bisection of the longest direction.
template <int Dim>
std::vector<Box<Dim>> split_box(const Box<Dim>& box, int pieces);

// Joins sub-blocks of the same zone and rank that together form a box: fewer, longer blocks run
// faster. The result is ordered by rank, zone and place.
template <int Dim>
std::vector<SubBlock<Dim>> merge_blocks(std::vector<SubBlock<Dim>> blocks);

}  // namespace wingbeat
