#pragma once

#include <span>
#include <vector>

namespace wingbeat {

// A flutter root at a point of a sweep.
struct SweptRoot {
  double reduced_velocity = 0.0;
  double frequency_ratio = 0.0;
};

// Numbers the roots of points that follow one another by the branch they lie on, from 1: [point][root]. A
// root belongs to the branch whose last two roots, carried on in a straight line, come nearest in frequency
// and speed; one that is near none begins a branch of its own. `places`: the parameter, ascending.
std::vector<std::vector<int>> linked_branches(std::span<const double> places,
                                              const std::vector<std::vector<SweptRoot>>& roots);

}  // namespace wingbeat
