#include "structure/linear_flutter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "structure/harmonic_motion.hpp"
#include "structure/section_matrix.hpp"
#include "structure/sketched_matrix.hpp"
#include "structure/typical_section.hpp"

namespace wingbeat {
namespace {

constexpr int max_equilibria = 8;

// The section at rest at the speed given, or undeflected where it carries no load.
template <int Dim>
AeroelasticState section_at_rest(FlowLevel<Dim>& level, const StructureModel& model,
                                 const SectionKinematics& kinematics, std::optional<double> reduced_velocity,
                                 const LinearFlutterOptions& options) {
  if (reduced_velocity) return static_equilibrium<Dim>(level, model, kinematics, *reduced_velocity, options);
  return {level.w, std::vector<double>(4, 0.0), 0.0, 1.0};
}

const FlutterRoot* lowest_destabilising(const std::vector<FlutterRoot>& roots) {
  for (const FlutterRoot& root : roots)
    if (root.is_destabilising()) return &root;
  return nullptr;
}

// Q(k) over the range of the options, sketched where that is enough.
template <int Dim>
AerodynamicTable table_of(const FlowLevel<Dim>& level, const SectionKinematics& kinematics,
                          LinearizedSection<Dim>& section, const LinearFlutterOptions& options) {
  if (options.sketch_accuracy) {
    const auto [k_min, k_max] = options.reduced_frequency_range;
    GmresOptions gmres = options.newton.gmres;
    gmres.relative_tolerance = options.tolerance;
    auto table = sketched_matrix<Dim>(level, kinematics.flow_speed,
                                      spread_reduced_frequencies(k_min, k_max, options.samples),
                                      *options.sketch_accuracy, gmres);
    if (table) return *std::move(table);
  }
  return sampled_matrix<Dim>(section, options);
}

// Polishes, with Q of a section, the destabilising roots that may turn out to be the lowest.
template <int Dim>
void polish_lowest(const StructureModel& model, LinearizedSection<Dim>& section,
                   const AerodynamicTable& table, const LinearFlutterOptions& options,
                   std::vector<FlutterRoot>& roots) {
  const double limit = options.polish_margin * lowest_destabilising(roots)->reduced_velocity;
  const auto exact = [&](double k) { return section.aerodynamic_matrix(k); };
  // The lowest last: its flow is then at hand.
  for (auto root = roots.rbegin(); root != roots.rend(); ++root)
    if (root->is_destabilising() && root->reduced_velocity <= limit)
      *root = polish_flutter_root(model, exact, table, *root, {.tolerance = 10.0 * options.tolerance});
  std::sort(roots.begin(), roots.end(), [](const FlutterRoot& a, const FlutterRoot& b) {
    return a.reduced_velocity < b.reduced_velocity;
  });
}

}  // namespace

bool is_deflected(const Loads<double>& loads) {
  return std::max(std::abs(loads.force_y), std::abs(loads.moment)) > 1e-9;
}

template <int Dim>
LinearizedSection<Dim>::LinearizedSection(FlowLevel<Dim>& level, const SectionKinematics& kinematics,
                                          AeroelasticState rest, double tolerance,
                                          std::function<bool()> is_stopped, const GmresOptions& gmres)
    : kinematics_(kinematics),
      rest_(std::move(rest)),
      solver_(std::make_shared<SchwarzSolver<std::complex<double>>>(level.comm(), level.subdomain,
                                                                    state_size<Dim>)),
      response_(level.steady, solver_, tolerance, gmres),
      is_stopped_(std::move(is_stopped)) {
  const std::vector<MotionState> motion{kinematics_.motion(rest_.y, rest_.r)};
  level.steady.linearize(rest_.w, motion, 0.0);
}

template <int Dim>
Eigen::MatrixXcd LinearizedSection<Dim>::aerodynamic_matrix(double k) {
  if (is_stopped_ && is_stopped_())
    throw SolveFailure(SolveStatus::interrupted,
                       "stopped by a signal or --walltime during the linearized problem");
  return aerodynamic_matrix_of(response_.at(kappa(k)).loads);
}

template <int Dim>
AeroelasticState LinearizedSection<Dim>::harmonic_state(const StructureModel& model, const TimeSpectral& time,
                                                        const Eigen::VectorXcd& u_hat, double omega,
                                                        double reduced_velocity) {
  const HarmonicResponse response = response_.at(kappa(omega / (2.0 * reduced_velocity)));
  AeroelasticState state;
  state.omega = omega;
  state.r = std::pow(reduced_velocity / kinematics_.reference_velocity, 2);
  state.y = harmonic_states(model, time, u_hat, omega);
  const std::complex<double> plunge_in_chords = SectionKinematics::semichord * u_hat[plunge_mode];
  for (int n = 0; n < time.instances(); ++n) {
    for (std::size_t j = 0; j < 4; ++j) state.y[4 * static_cast<std::size_t>(n) + j] += rest_.y[j];
    const std::complex<double> turn = std::polar(1.0, time.phase(n));
    const auto plunge_turn = turn * plunge_in_chords, pitch_turn = turn * u_hat[pitch_mode];
    for (std::size_t i = 0; i < rest_.w.size(); ++i)
      state.w.push_back(rest_.w[i] +
                        (plunge_turn * response.plunge[i] + pitch_turn * response.pitch[i]).real());
  }
  return state;
}

template <int Dim>
AeroelasticState static_equilibrium(FlowLevel<Dim>& level, const StructureModel& model,
                                    const SectionKinematics& kinematics, double reduced_velocity,
                                    const LinearFlutterOptions& options) {
  AeroelasticState start{level.w, std::vector<double>(4, 0.0), 0.0,
                         std::pow(reduced_velocity / kinematics.reference_velocity, 2)};
  AeroelasticProblem<Dim> problem(level.steady, StructuralEquation(model, TimeSpectral(0)), kinematics,
                                  std::nullopt, start, {level.solver, {}}, options.tolerances);
  std::vector<double> u = problem.unknowns(start);
  const NewtonResult result = newton(level.comm(), problem, u, options.newton);
  if (result.status != SolveStatus::converged)
    throw SolveFailure(
        result.status,
        fmt::format("static equilibrium of the section at V = {:.4g} was not found: Newton ended with "
                    "{}; the section may diverge there, or solver.max_newton_iterations is too low",
                    reduced_velocity, to_string(result.status)));
  return problem.state(u);
}

template <int Dim>
AerodynamicTable sampled_matrix(LinearizedSection<Dim>& section, const LinearFlutterOptions& options) {
  const auto [k_min, k_max] = options.reduced_frequency_range;
  return tabulate([&](double k) { return section.aerodynamic_matrix(k); },
                  spread_reduced_frequencies(k_min, k_max, options.samples));
}

template <int Dim>
LinearFlutterSolution<Dim> solve_linear_flutter(FlowLevelRange<Dim> levels, const StructureModel& model,
                                                const SectionKinematics& kinematics,
                                                const LinearFlutterOptions& options) {
  const std::vector<MotionState> unmoved{{kinematics.mean_pitch, 0.0, 0.0}};
  const bool deflects = is_deflected(levels.back()->steady.loads(levels.back()->w, unmoved)[0]);
  LinearFlutterSolution<Dim> solution;
  std::optional<AerodynamicTable> table;
  std::optional<double> speed;  // at which the section rests, once a root is known

  std::vector<FlowLevel<Dim>*> solved;
  for (const auto& level : levels)
    if (!level->w.empty()) solved.push_back(level.get());
  for (FlowLevel<Dim>* level : solved)
    for (int repeat = 0; repeat < max_equilibria; ++repeat) {
      solution.section = std::make_unique<LinearizedSection<Dim>>(
          *level, kinematics, section_at_rest<Dim>(*level, model, kinematics, speed, options),
          options.tolerance, options.is_stopped, options.newton.gmres);
      if (level == solved.front()) {
        table = table_of<Dim>(*level, kinematics, *solution.section, options);
        solution.flutter.roots = scan_flutter_roots(model, *table);
      } else {
        polish_lowest(model, *solution.section, *table, options, solution.flutter.roots);
      }
      const FlutterRoot* lowest = lowest_destabilising(solution.flutter.roots);
      if (!lowest) return solution;
      const double found = lowest->reduced_velocity;
      const bool is_settled = speed && std::abs(found - *speed) < options.settled_speed * found;
      if (deflects) speed = found;
      if (!deflects || is_settled) break;
    }
  if (solved.size() == 1) polish_lowest(model, *solution.section, *table, options, solution.flutter.roots);
  solution.flutter.root = *lowest_destabilising(solution.flutter.roots);
  return solution;
}

template class LinearizedSection<2>;
template AeroelasticState static_equilibrium<2>(FlowLevel<2>&, const StructureModel&,
                                                const SectionKinematics&, double,
                                                const LinearFlutterOptions&);
template AerodynamicTable sampled_matrix<2>(LinearizedSection<2>&, const LinearFlutterOptions&);
template LinearFlutterSolution<2> solve_linear_flutter<2>(FlowLevelRange<2>, const StructureModel&,
                                                          const SectionKinematics&,
                                                          const LinearFlutterOptions&);
template class LinearizedSection<3>;
template AeroelasticState static_equilibrium<3>(FlowLevel<3>&, const StructureModel&,
                                                const SectionKinematics&, double,
                                                const LinearFlutterOptions&);
template AerodynamicTable sampled_matrix<3>(LinearizedSection<3>&, const LinearFlutterOptions&);
template LinearFlutterSolution<3> solve_linear_flutter<3>(FlowLevelRange<3>, const StructureModel&,
                                                          const SectionKinematics&,
                                                          const LinearFlutterOptions&);

}  // namespace wingbeat
