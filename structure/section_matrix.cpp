#include "structure/section_matrix.hpp"

#include "structure/section_kinematics.hpp"
#include "structure/typical_section.hpp"

namespace wingbeat {

Eigen::MatrixXcd aerodynamic_matrix_of(const LoadResponse& loads) {
  constexpr double b = SectionKinematics::semichord;
  Eigen::MatrixXcd q(2, 2);
  q(0, plunge_mode) = -b * loads.plunge[0];
  q(1, plunge_mode) = 2.0 * b * loads.plunge[1];
  q(0, pitch_mode) = -loads.pitch[0];
  q(1, pitch_mode) = 2.0 * loads.pitch[1];
  return q;
}

}  // namespace wingbeat
