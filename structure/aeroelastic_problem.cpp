#include "structure/aeroelastic_problem.hpp"

#include <algorithm>
#include <cmath>

#include "flow/step_limit.hpp"

namespace wingbeat {
namespace {

double sum_of_squares(std::span<const double> x) {
  double sum = 0.0;
  for (double value : x) sum += value * value;
  return sum;
}

// One instance's values for all of them.
std::vector<double> repeated(const std::vector<double>& one, std::size_t instances) {
  std::vector<double> all;
  for (std::size_t n = 0; n < instances; ++n) all.insert(all.end(), one.begin(), one.end());
  return all;
}

}  // namespace

template <int Dim>
AeroelasticProblem<Dim>::AeroelasticProblem(FlowEquations<Dim>& flow, StructuralEquation structure,
                                            const SectionKinematics& kinematics,
                                            std::optional<CycleCondition> cycle, AeroelasticState base,
                                            HarmonicFactors factors, const AeroelasticTolerances& tolerances)
    : flow_(flow),
      structure_(std::move(structure)),
      cycle_(std::move(cycle)),
      base_(std::move(base)),
      tolerances_(tolerances),
      scale_(cycle_ ? std::sqrt(cycle_->energy.energy) : 1.0),
      uniform_residual_(flow.uniform_residual()),
      linearization_{&flow, kinematics, base_.r, cycle_.has_value(), {}, {}, {}, {}},
      jacobian_(linearization_),
      harmonic_(flow.domain(), flow.time(), std::move(factors)),
      preconditioner_(linearization_, harmonic_) {
  base_.w = repeated(base_.w, flow.instance_count());
  base_.y = repeated(base_.y, flow.instance_count());
  if (is_periodic()) phase_ = phase_condition(structure_.model(), flow.time());
}

template <int Dim>
std::size_t AeroelasticProblem<Dim>::local_size() const {
  return jacobian_.local_size();
}

template <int Dim>
std::vector<double> AeroelasticProblem<Dim>::unknowns(const AeroelasticState& state) const {
  std::vector<double> u;
  u.reserve(local_size());
  for (std::size_t i = 0; i < state.w.size(); ++i) u.push_back((state.w[i] - base_.w[i]) / scale_);
  if (!flow_.domain().comm().is_root()) return u;
  for (std::size_t i = 0; i < state.y.size(); ++i) u.push_back((state.y[i] - base_.y[i]) / scale_);
  if (is_periodic()) u.insert(u.end(), {state.omega, state.r});
  return u;
}

template <int Dim>
AeroelasticState AeroelasticProblem<Dim>::state(std::span<const double> u) const {
  const std::vector<double> tail =
      broadcast_tail(flow_.domain().comm(), u, flow_.state_count(), linearization_.tail_size());
  AeroelasticState state = base_;
  for (std::size_t i = 0; i < state.w.size(); ++i) state.w[i] += scale_ * u[i];
  for (std::size_t i = 0; i < state.y.size(); ++i) state.y[i] += scale_ * tail[i];
  if (is_periodic()) {
    state.omega = tail[state.y.size()];
    state.r = tail[state.y.size() + 1];
  }
  return state;
}

template <int Dim>
std::vector<double> AeroelasticProblem<Dim>::by_unknowns(const AeroelasticState& by_state) const {
  std::vector<double> u = by_state.w;
  if (flow_.domain().comm().is_root()) u.insert(u.end(), by_state.y.begin(), by_state.y.end());
  for (double& value : u) value *= scale_;
  if (is_periodic() && flow_.domain().comm().is_root()) u.insert(u.end(), {by_state.omega, by_state.r});
  return u;
}

template <int Dim>
std::vector<double> AeroelasticProblem<Dim>::rows(std::span<const double> flow,
                                                  std::span<const double> structure, double cycle) const {
  std::vector<double> f(flow.begin(), flow.end());
  if (flow_.domain().comm().is_root()) f.insert(f.end(), structure.begin(), structure.end());
  for (double& value : f) value /= scale_;
  if (is_periodic() && flow_.domain().comm().is_root()) f.insert(f.end(), {0.0, cycle});
  return f;
}

template <int Dim>
AeroelasticMultipliers AeroelasticProblem<Dim>::multipliers(std::span<const double> lambda) const {
  const std::vector<double> tail =
      broadcast_tail(flow_.domain().comm(), lambda, flow_.state_count(), linearization_.tail_size());
  const auto states = static_cast<std::ptrdiff_t>(base_.y.size());
  AeroelasticMultipliers result;
  result.flow.assign(lambda.begin(), lambda.begin() + static_cast<std::ptrdiff_t>(flow_.state_count()));
  result.structure.assign(tail.begin(), tail.begin() + states);
  for (double& value : result.flow) value /= scale_;
  for (double& value : result.structure) value /= scale_;
  if (is_periodic()) {
    result.phase = tail[base_.y.size()] / scale_;
    result.cycle = tail[base_.y.size() + 1];
  }
  return result;
}

template <int Dim>
std::vector<MotionState> AeroelasticProblem<Dim>::motions(const AeroelasticState& state) const {
  std::vector<MotionState> result;
  for (std::size_t n = 0; n < flow_.instance_count(); ++n)
    result.push_back(
        linearization_.kinematics.motion(std::span<const double>(state.y).subspan(4 * n, 4), state.r));
  return result;
}

template <int Dim>
std::vector<double> AeroelasticProblem<Dim>::forces(const AeroelasticState& state) {
  std::vector<double> f;
  for (const Loads<double>& loads : flow_.loads(state.w, motions(state)))
    f.insert(f.end(), {-loads.force_y, 2.0 * loads.moment});
  return f;
}

template <int Dim>
bool AeroelasticProblem<Dim>::residual(std::span<const double> u, std::span<double> f) {
  const AeroelasticState at = state(u);
  const Comm& comm = flow_.domain().comm();
  const double gamma = flow_.model().freestream.gamma;
  if (comm.any(!(at.r > 0.0) || !is_physical<Dim>(at.w, gamma))) return false;

  const SectionKinematics& kinematics = linearization_.kinematics;
  const auto rw = f.first(flow_.state_count());
  flow_.residual(at.w, motions(at), kinematics.kappa(at.omega, at.r), rw);
  for (double& value : rw) value /= scale_;
  const std::vector<double> loads = forces(at);
  if (!comm.is_root()) return true;

  const auto tail = f.subspan(flow_.state_count());
  const double load = structure_.model().load(kinematics.reduced_velocity(at.r));
  const auto s = tail.first(at.y.size());
  structure_.residual(at.y, at.omega, load, loads, s);
  for (double& value : s) value /= scale_;
  if (is_periodic()) {
    tail[at.y.size()] = value(AmplitudeCondition(phase_), at.y) / scale_;
    tail[at.y.size() + 1] =
        cycle_->by_energy * value(AmplitudeCondition(cycle_->energy), at.y) +
        cycle_->by_speed * (kinematics.reduced_velocity(at.r) / cycle_->reduced_velocity - 1.0);
  }
  return true;
}

template <int Dim>
AeroelasticResiduals AeroelasticProblem<Dim>::measure(std::span<const double> f) const {
  const Comm& comm = flow_.domain().comm();
  AeroelasticResiduals result;
  result.flow =
      scale_ * std::sqrt(comm.sum(sum_of_squares(f.first(flow_.state_count())))) / uniform_residual_;
  const std::vector<double> tail = broadcast_tail(comm, f, flow_.state_count(), linearization_.tail_size());
  const std::size_t states = base_.y.size();
  result.structure = std::sqrt(sum_of_squares(std::span<const double>(tail).first(states)));
  if (is_periodic()) {
    result.phase = std::abs(tail[states]);
    result.energy = std::abs(tail[states + 1]);
  }
  return result;
}

template <int Dim>
double AeroelasticProblem<Dim>::excess(std::span<const double> f) const {
  const AeroelasticResiduals r = measure(f);
  return std::max(r.flow / tolerances_.flow,
                  std::max({r.structure, r.phase, r.energy}) / tolerances_.structure);
}

template <int Dim>
void AeroelasticProblem<Dim>::linearize(std::span<const double> u) {
  const AeroelasticState at = state(u);
  linearization_.r = at.r;
  omega_ = at.omega;
  flow_.linearize(at.w, motions(at), linearization_.kinematics.kappa(at.omega, at.r));
  if (is_periodic()) linearize_flow_by_frequency(at, u);
  linearize_tail(at, forces(at));
  if (!is_factored()) return;
  if (!preconditioner_.has_responses()) preconditioner_.build_responses();
  preconditioner_.update_schur();
}

// R_omega and R_r, over s: kappa depends on both, the mesh velocity on r. The time derivative of
// the base state is zero, so that w^ alone enters.
template <int Dim>
void AeroelasticProblem<Dim>::linearize_flow_by_frequency(const AeroelasticState& at,
                                                          std::span<const double> u) {
  const SectionKinematics& kinematics = linearization_.kinematics;
  const std::size_t count = flow_.domain().state_count();
  auto& by_omega = linearization_.flow_by_omega;
  auto& by_r = linearization_.flow_by_r;
  by_omega.assign(flow_.state_count(), 0.0);
  by_r.assign(flow_.state_count(), 0.0);
  const auto w = u.first(flow_.state_count());
  flow_.add_time_derivative(kinematics.clock_ratio(at.r), w, by_omega);
  flow_.add_time_derivative(-kinematics.kappa(at.omega, at.r) / (2.0 * at.r), w, by_r);
  const std::vector<MotionState> moved = motions(at);
  for (std::size_t n = 0; n < flow_.instance_count(); ++n) {
    const MotionState by = kinematics.motion_by_r(moved[n], at.r);
    const auto& columns = flow_.motion_gradients(n);
    for (std::size_t i = 0; i < count; ++i)
      by_r[n * count + i] += (by.pitch_rate * columns[1][i] + by.plunge_rate * columns[2][i]) / scale_;
  }
}

template <int Dim>
void AeroelasticProblem<Dim>::linearize_tail(const AeroelasticState& at, const std::vector<double>& f) {
  const auto states = static_cast<Eigen::Index>(at.y.size());
  const auto size = static_cast<Eigen::Index>(linearization_.tail_size());
  const double load = structure_.model().load(linearization_.kinematics.reduced_velocity(at.r));

  auto& by_force = linearization_.by_force;
  by_force.setZero(size, static_cast<Eigen::Index>(f.size()));
  for (std::size_t j = 0; j < f.size(); ++j) {
    std::vector<double> unit(f.size(), 0.0), column(at.y.size(), 0.0);
    unit[j] = 1.0;
    structure_.add_force_tangent(load, unit, 1.0, column);
    by_force.col(static_cast<Eigen::Index>(j)).head(states) =
        Eigen::Map<Eigen::VectorXd>(column.data(), states);
  }

  Eigen::MatrixXd& tail = linearization_.tail;
  tail.setZero(size, size);
  tail.topLeftCorner(states, states) = structure_.state_jacobian(at.y, at.omega);
  // Loads turn with the section at given pressures.
  for (std::size_t n = 0; n < flow_.instance_count(); ++n) {
    const auto& loads = flow_.linearized_loads(n);
    const auto j = static_cast<Eigen::Index>(2 * n);
    tail.col(static_cast<Eigen::Index>(4 * n + 1)) +=
        -loads.force_y.gradient[0] * by_force.col(j) + 2.0 * loads.moment.gradient[0] * by_force.col(j + 1);
  }
  if (!is_periodic()) return;

  std::vector<double> column(at.y.size(), 0.0);
  structure_.frequency_derivative(at.y, column);
  tail.col(states).head(states) = Eigen::Map<Eigen::VectorXd>(column.data(), states) / scale_;
  structure_.load_derivative(f, column);
  tail.col(states + 1).head(states) =
      Eigen::Map<Eigen::VectorXd>(column.data(), states) * (load / at.r / scale_);
  std::vector<double> row(at.y.size(), 0.0);
  add_gradient(AmplitudeCondition(phase_), at.y, 1.0, row);
  tail.row(states).head(states) = Eigen::Map<Eigen::RowVectorXd>(row.data(), states);
  std::fill(row.begin(), row.end(), 0.0);
  add_gradient(AmplitudeCondition(cycle_->energy), at.y, cycle_->by_energy * scale_, row);
  tail.row(states + 1).head(states) = Eigen::Map<Eigen::RowVectorXd>(row.data(), states);
  tail(states + 1, states + 1) = cycle_->by_speed * linearization_.kinematics.reduced_velocity(at.r) /
                                 (2.0 * at.r * cycle_->reduced_velocity);
}

template <int Dim>
void AeroelasticProblem<Dim>::refactor() {
  const double kappa = linearization_.kinematics.kappa(omega_, linearization_.r);
  if (is_factored())
    harmonic_.factor(flow_, kappa);
  else
    harmonic_.factor_missing(flow_, kappa);
  preconditioner_.build_responses();
  preconditioner_.update_schur();
}

template <int Dim>
double AeroelasticProblem<Dim>::step_limit(std::span<const double> u, std::span<const double> du) const {
  const Comm& comm = flow_.domain().comm();
  const AeroelasticState at = state(u);
  std::vector<double> dw(du.begin(), du.begin() + static_cast<std::ptrdiff_t>(at.w.size()));
  for (double& value : dw) value *= scale_;
  double step = largest_step<Dim>(at.w, dw, flow_.model().freestream.gamma, 0.25);
  if (is_periodic() && comm.is_root()) {
    // The frequency and the speed may halve or double at most.
    const double omega_change = std::abs(du[du.size() - 2]), r_change = std::abs(du[du.size() - 1]);
    if (omega_change * step > 0.5 * at.omega) step = 0.5 * at.omega / omega_change;
    if (r_change * step > 0.5 * at.r) step = 0.5 * at.r / r_change;
  }
  return comm.min(step);
}

template class AeroelasticProblem<2>;
template class AeroelasticProblem<3>;

}  // namespace wingbeat
