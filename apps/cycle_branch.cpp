#include "apps/cycle_branch.hpp"

#include <cmath>

#include "apps/flow_setup.hpp"
#include "structure/energy.hpp"

namespace wingbeat {
namespace {

// Speeds change by some per cent of themselves where amplitudes change by all of theirs: amplitude leads,
// but where the branch runs along the axis of speeds.
constexpr double speed_scale = 1.0;
// Few long steps beat many short ones: most of a correction's Krylov iterations come at its end.
constexpr int wanted_iterations = 7;
// Steps between the cycles asked for are solved to this many times the tolerances.
constexpr double looseness_between = 1e4;
// A correction that takes more iterations than this is cheaper with half the step.
constexpr int most_iterations = 12;

constexpr const char* branch_stage = "branch";

// Instances of all harmonics of a field, with one harmonic more.
std::vector<double> with_harmonic(std::span<const double> field, const TimeSpectral& time) {
  std::vector<std::complex<double>> harmonics = time.harmonics_of(field);
  harmonics.resize(harmonics.size() + field.size() / static_cast<std::size_t>(time.instances()));
  return TimeSpectral(time.harmonics() + 1).instances_of(harmonics);
}

AeroelasticState with_harmonic(const AeroelasticState& state) {
  const TimeSpectral time = time_of(state);
  return {with_harmonic(state.w, time), with_harmonic(state.y, time), state.omega, state.r};
}

// One vector of a state: the rank's w, then y, omega and r, which all ranks hold.
std::vector<double> packed(const AeroelasticState& state) {
  std::vector<double> u = state.w;
  u.insert(u.end(), state.y.begin(), state.y.end());
  u.insert(u.end(), {state.omega, state.r});
  return u;
}

}  // namespace

CycleBranch::CycleBranch(Context& context, const StructureModel& model, CycleSolver& solver, CycleStart start,
                         double largest_energy)
    : context_(context),
      model_(model),
      solver_(solver),
      start_(std::move(start)),
      largest_energy_(largest_energy),
      harmonics_(time_of(start_.state).harmonics()) {}

BranchPoint CycleBranch::point_of(const AeroelasticState& state) const {
  return {packed(state), std::sqrt(fluctuating_energy(model_, state.y)),
          section_kinematics(context_.settings).reduced_velocity(state.r)};
}

AeroelasticState CycleBranch::state_of(const std::vector<double>& u) const {
  const auto states = static_cast<std::ptrdiff_t>(4 * (2 * harmonics_ + 1));
  const auto tail = u.end() - 2 - states;
  return {{u.begin(), tail}, {tail, u.end() - 2}, u[u.size() - 2], u[u.size() - 1]};
}

SolveStatus CycleBranch::begin(double energy) {
  BranchPoint first = point_of(start_.state);
  const Correction correction = correct(first, {std::sqrt(energy), first.speed, 1.0, 0.0});
  if (correction.status != SolveStatus::converged) return correction.status;
  // The branch grows from the state of rest.
  AeroelasticState rest = solution_.state;
  for (std::size_t i = 0; i < rest.w.size(); ++i) rest.w[i] = start_.rest.w[i % start_.rest.w.size()];
  for (std::size_t i = 0; i < rest.y.size(); ++i) rest.y[i] = start_.rest.y[i % start_.rest.y.size()];
  BranchPoint behind = point_of(rest);
  behind.amplitude = 0.0;
  BranchOptions options;
  options.amplitude_scale = std::sqrt(std::max(largest_energy_, energy));
  options.speed_scale = speed_scale * first.speed;
  options.step = context_.settings.lco.step;
  if (const auto earlier = context_.checkpoints.recall(branch_stage)) options.step = earlier->numbers.at(0);
  options.wanted_iterations = wanted_iterations;
  // A shock passes over cells within a step: parabolas through what it leaves there lead astray.
  options.order = 1;
  follower_ = std::make_unique<BranchFollower>(
      std::move(behind), std::move(first), options,
      [this](BranchPoint& point, const BranchRow& row) { return correct(point, row); });
  return SolveStatus::converged;
}

std::optional<SolverMemory> CycleBranch::memory() const {
  if (!follower_) return std::nullopt;
  return SolverMemory{branch_stage, {follower_->step()}, {}};
}

bool CycleBranch::needs_harmonic(const AeroelasticState& state) const {
  const LcoSettings& lco = context_.settings.lco;
  return lco.harmonic_share && harmonics_ < lco.max_harmonics &&
         highest_harmonic_share(model_, time_of(state), state.y) > *lco.harmonic_share;
}

void CycleBranch::add_harmonic() {
  if (follower_)
    follower_->convert([this](const std::vector<double>& u) { return packed(with_harmonic(state_of(u))); });
  ++harmonics_;
  solver_.add_harmonic(start_.factors);
}

Correction CycleBranch::correct(BranchPoint& point, const BranchRow& row) {
  ++count_;
  start_.state = state_of(point.u);
  CycleCondition condition(energy_condition(model_, row.amplitude * row.amplitude));
  // E is quadratic in the amplitude.
  const double norm = 0.5 * std::abs(row.by_amplitude) + std::abs(row.by_speed);
  condition.by_energy = 0.5 * row.by_amplitude / norm;
  condition.by_speed = row.by_speed / norm;
  condition.reduced_velocity = row.speed;
  Correction correction;
  while (true) {
    const std::string stage = fmt::format("cycle {}, E_0 {:.3g}", count_, condition.energy.energy);
    // Steps between, on a line across the branch, only lead on.
    const bool is_asked = row.by_amplitude == 0.0 || row.by_speed == 0.0;
    solution_ = solver_.solve_coupled(stage, start_, condition,
                                      {most_iterations, is_asked ? 1.0 : looseness_between, is_asked});
    correction.status = solution_.status;
    correction.iterations += solution_.newton_iterations;
    if (solution_.status != SolveStatus::converged) return correction;
    if (!needs_harmonic(solution_.state)) break;
    context_.log.line("harmonic {} carries {:.1e} of the energy: {} harmonics from here on", harmonics_,
                      highest_harmonic_share(model_, time_of(solution_.state), solution_.state.y),
                      harmonics_ + 1);
    add_harmonic();
    start_.state = with_harmonic(solution_.state);
  }
  point = point_of(solution_.state);
  return correction;
}

BranchStep CycleBranch::advance(const BranchTarget& target) {
  // A smaller cycle than the last lies the other way, unless the branch has a fold: that is for speeds.
  if (target.kind == BranchTarget::Kind::amplitude && follower_->grows() != (target.value > last().amplitude))
    follower_->turn();
  return follower_->advance(target);
}

BranchStep CycleBranch::advance_to_energy(double energy) {
  return advance({BranchTarget::Kind::amplitude, std::sqrt(energy)});
}

BranchStep CycleBranch::advance_to_speed(double reduced_velocity) {
  return advance({BranchTarget::Kind::speed, reduced_velocity});
}

std::optional<BranchStep> CycleBranch::look_back_for_speed(double reduced_velocity) {
  return follower_->look_back({BranchTarget::Kind::speed, reduced_velocity});
}

}  // namespace wingbeat
