#include <algorithm>
#include <numbers>

#include "apps/case_mesh.hpp"
#include "apps/flow_setup.hpp"
#include "apps/forced_output.hpp"
#include "apps/pitch_stage.hpp"
#include "apps/verbs.hpp"
#include "structure/forced_matrix.hpp"
#include "structure/linear_flutter.hpp"

namespace wingbeat {
namespace {

// Q(k) by small forced motions beside the linearized one, about the level's steady flow. With a single
// harmonic the second, of the square of the amplitude, would be taken for the first.
void compute_derivatives(Context& context, FlowLevel<2>& level) {
  const auto part = context.timer.measure("derivatives");
  const CaseSettings& settings = context.settings;
  const double k = *settings.pitch.reduced_frequency;
  const SectionKinematics kinematics = section_kinematics(settings);
  const TimeSpectral time(std::max(2, settings.time.harmonics));
  ForcedMatrixOptions options;
  options.amplitude = settings.pitch.derivative_amplitude_deg * std::numbers::pi / 180.0;
  options.flow = forced_flow_options(settings.solver);
  options.observer = [&](const ForcedFlowIteration&) { return !context.stop.is_set(); };
  const Eigen::Matrix2cd forced = forced_aerodynamic_matrix<2>(level, time, kinematics, k, options);
  LinearizedSection<2> section(level, kinematics, {level.w, std::vector<double>(4, 0.0), 0.0, 1.0}, 1e-10, {},
                               gmres_options(settings.solver));
  report_derivatives(context, forced, section.aerodynamic_matrix(k));
}

}  // namespace

std::vector<std::string> pitch_faults(const CaseSettings& settings) {
  const PitchSettings& pitch = settings.pitch;
  std::vector<std::string> faults;
  if (!pitch.reduced_frequency)
    faults.push_back(
        "pitch.reduced_frequency: missing; wingbeat pitch needs it: k = omega b/U of the motion (number, > "
        "0)");
  const auto check = [&](const char* key, const std::vector<double>& values) {
    int highest = static_cast<int>(values.size());
    while (highest > 0 && values[static_cast<std::size_t>(highest - 1)] == 0.0) --highest;
    if (highest > settings.time.harmonics)
      faults.push_back(
          fmt::format("pitch.{}: moves harmonic {}, beyond time.harmonics = {}; set "
                      "time.harmonics to {} or more",
                      key, highest, settings.time.harmonics, highest));
  };
  check("sine_deg", pitch.sine_deg);
  check("cosine_deg", pitch.cosine_deg);
  check("plunge_sine", pitch.plunge_sine);
  check("plunge_cosine", pitch.plunge_cosine);
  if (forced_motion(pitch).harmonics() == 0)
    faults.push_back(
        "pitch.amplitude_deg: the section does not move; give this key, or one of pitch.sine_deg, "
        "pitch.cosine_deg, pitch.plunge_sine and pitch.plunge_cosine");
  return faults;
}

SolveStatus run_pitch(Context& context) {
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(context.comm, context.settings.mesh));
  History history(context);
  const bool derivatives = context.settings.pitch.derivatives;
  const SolveStatus status = run_pitch_stage(context, levels, history, derivatives).status;
  if (derivatives && status == SolveStatus::converged) compute_derivatives(context, *levels.back());
  return status;
}

}  // namespace wingbeat
