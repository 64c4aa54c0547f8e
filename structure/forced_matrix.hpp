#pragma once

#include <Eigen/Dense>
#include <functional>

#include "flow/forced_flow.hpp"
#include "structure/section_kinematics.hpp"

namespace wingbeat {

struct ForcedMatrixOptions {
  double amplitude = 1e-3;  // of pitch, radians; plunge h/b = amplitude/k inclines the stream as much
  ForcedFlowOptions flow{};
  ForcedFlowObserver observer{};
};

// The aerodynamic matrix Q(k) of eq:aerodynamic-matrix by differences (eq:forced-matrix): first
// harmonics of the loads of two periodic flows, the section forced in plunge and in pitch by turns
// about the level's steady flow, over the amplitudes. Off by a term in amplitude^2; with one harmonic
// only, by one in the amplitude unless the section is symmetric and at rest at no incidence. Collective.
// Throws SolveFailure where a flow does not converge.
template <int Dim>
Eigen::Matrix2cd forced_aerodynamic_matrix(FlowLevel<Dim>& level, const TimeSpectral& time,
                                           const SectionKinematics& kinematics, double k,
                                           const ForcedMatrixOptions& options);

}  // namespace wingbeat
