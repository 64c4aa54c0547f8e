#pragma once

#include <Eigen/Core>

#include "flow/frequency_operator.hpp"

namespace wingbeat {

// Q = f over (h/b, alpha) of the loads of small motion, f = (-C_l, 2 C_m) (eq:aerodynamic-matrix).
Eigen::MatrixXcd aerodynamic_matrix_of(const LoadResponse& loads);

}  // namespace wingbeat
