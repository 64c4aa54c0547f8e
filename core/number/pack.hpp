#pragma once

#include <experimental/simd>

namespace wingbeat {

// As many doubles as the machine's widest vector holds: one face or cell a lane.
using Pack = std::experimental::native_simd<double>;

}  // namespace wingbeat
