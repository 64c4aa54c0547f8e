#pragma once

#include <complex>

namespace wingbeat {

inline constexpr std::complex<double> i_unit{0.0, 1.0};

}  // namespace wingbeat
