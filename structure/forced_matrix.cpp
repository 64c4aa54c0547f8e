#include "structure/forced_matrix.hpp"

#include <fmt/format.h>

#include "core/io/error.hpp"
#include "structure/typical_section.hpp"

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

// First harmonics of f = (-C_l, 2 C_m) under a motion.
template <int Dim>
Eigen::Vector2cd forced_loads(FlowLevel<Dim>& level, FlowEquations<Dim>& flow, const ForcedMotion& motion,
                              double kappa, const ForcedMatrixOptions& options) {
  ForcedFlowStart start = linear_start<Dim>(level, flow.time(), motion, kappa, options.flow.newton.gmres);
  const std::vector<MotionState> motions = motions_of(motion, flow.time(), kappa);
  const ForcedFlowResult result =
      solve_forced_flow<Dim>(flow, start.factors, motions, kappa, start.w, options.flow, options.observer);
  if (result.status != SolveStatus::converged)
    throw SolveFailure(result.status,
                       fmt::format("forced motion of small amplitude: Newton ended with {} at relative "
                                   "residual {:.1e}; lower pitch.derivative_amplitude_deg, or raise "
                                   "solver.max_newton_iterations",
                                   to_string(result.status), result.residual));
  std::vector<double> f;
  for (const Loads<double>& loads : flow.loads(start.w, motions))
    f.insert(f.end(), {-loads.force_y, 2.0 * loads.moment});
  const std::vector<Complex> harmonics = flow.time().harmonics_of(f);
  return {harmonics[2], harmonics[3]};
}

}  // namespace

template <int Dim>
Eigen::Matrix2cd forced_aerodynamic_matrix(FlowLevel<Dim>& level, const TimeSpectral& time,
                                           const SectionKinematics& kinematics, double k,
                                           const ForcedMatrixOptions& options) {
  ensure(time.harmonics() >= 1, "a forced motion needs a harmonic");
  FlowEquations<Dim> flow(level.domain, level.steady.model(), time);
  const double kappa = 2.0 * k * kinematics.flow_speed;
  const Complex pitch(0.0, -options.amplitude);  // a sine
  const Complex plunge = pitch / k;              // semichords
  ForcedMotion motion{.mean_pitch = kinematics.mean_pitch, .pitch = {}, .plunge = {}};
  Eigen::Matrix2cd q;
  motion.plunge = {SectionKinematics::semichord * plunge};
  q.col(plunge_mode) = forced_loads<Dim>(level, flow, motion, kappa, options) / plunge;
  motion.plunge = {};
  motion.pitch = {pitch};
  q.col(pitch_mode) = forced_loads<Dim>(level, flow, motion, kappa, options) / pitch;
  return q;
}

template Eigen::Matrix2cd forced_aerodynamic_matrix<2>(FlowLevel<2>&, const TimeSpectral&,
                                                       const SectionKinematics&, double,
                                                       const ForcedMatrixOptions&);

}  // namespace wingbeat
