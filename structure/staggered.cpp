#include "structure/staggered.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/io/error.hpp"
#include "flow/flux_balance.hpp"
#include "structure/energy.hpp"
#include "structure/staggered_energy_search.hpp"
#include "structure/staggered_update.hpp"

namespace wingbeat {
namespace {

constexpr double largest_change = 1.1;  // factor of omega, and of V, in a step
constexpr double widest_range = 3.0;    // omega and r, about their start
constexpr int patience = 300;           // structural steps without a new best
// When the energy of a cycle may change in search of its speed.
constexpr double settled_change = 0.02;   // of r in a step, relative to its distance from the target
constexpr double settled_residual = 0.1;  // of the structure, likewise
constexpr int steps_to_settle = 5;

double norm(std::span<const double> x) {
  double sum = 0.0;
  for (double value : x) sum += value * value;
  return std::sqrt(sum);
}

bool is_within(double value, double start) {
  return value > start / widest_range && value < start * widest_range;
}

// At most a factor away; far out the fit means little.
double limited(double value, double from, double factor) {
  return std::clamp(value, from / factor, from * factor);
}

// What the instances differ by, times a factor.
void scale_fluctuation(std::vector<double>& w, std::size_t instances, double factor) {
  const std::size_t width = w.size() / instances;
  for (std::size_t i = 0; i < width; ++i) {
    double mean = 0.0;
    for (std::size_t n = 0; n < instances; ++n) mean += w[n * width + i] / static_cast<double>(instances);
    for (std::size_t n = 0; n < instances; ++n) {
      double& value = w[n * width + i];
      value = mean + factor * (value - mean);
    }
  }
}

template <int Dim>
class Staggered {
 public:
  Staggered(const FlowCycle& cycle, FlowEquations<Dim>& flow, const StructuralEquation& structure,
            const SectionKinematics& kinematics, const CycleAmplitude& amplitude,
            const StaggeredOptions& options, AeroelasticState& state, const StaggeredMemory* earlier)
      : cycle_(cycle),
        flow_(flow),
        comm_(flow.domain().comm()),
        structure_(structure),
        kinematics_(kinematics),
        options_(options),
        state_(state),
        phase_(phase_condition(structure.model(), structure.time())),
        uniform_residual_(flow.uniform_residual()),
        relaxation_(options.relaxation) {
    if (earlier) {
      go_on(amplitude, *earlier);
      return;
    }
    if (const auto* given = std::get_if<GivenEnergy>(&amplitude)) {
      energy_ = energy_condition(structure.model(), given->energy).energy;
    } else {
      const auto& speed = std::get<GivenSpeed>(amplitude);
      search_.emplace(r_of(speed), speed.initial_energy);
      energy_ = search_->energy();
    }
    normalize(state_.y);
    start_omega_ = state_.omega;
    start_r_ = state_.r;
    best_ = state_;
  }

  StaggeredResult solve(const StaggeredObserver& observer);

 private:
  void go_on(const CycleAmplitude& amplitude, const StaggeredMemory& earlier);
  StaggeredMemory memory() const;
  double r_of(const GivenSpeed& speed) const {
    return std::pow(speed.reduced_velocity / kinematics_.reference_velocity, 2);
  }
  void normalize(std::vector<double>& y) const;
  void advance_flow();
  bool measure();  // false where the iterate makes no sense
  void keep_best();
  double merit(const AeroelasticResiduals& residuals) const;
  bool is_converged() const;
  void advance_structure();
  void take_structural_step();
  void advance_energy();
  bool recover();
  std::vector<MotionState> motions() const;

  const FlowCycle& cycle_;
  FlowEquations<Dim>& flow_;
  const Comm& comm_;
  const StructuralEquation& structure_;
  SectionKinematics kinematics_;
  StaggeredOptions options_;
  AeroelasticState& state_;
  HarmonicCondition phase_;
  double uniform_residual_;
  double relaxation_;
  double energy_ = 0.0;
  std::optional<EnergySearch> search_;
  double previous_r_ = 0.0;
  int settled_steps_ = 0;

  double start_omega_ = 0.0, start_r_ = 0.0;
  AeroelasticState best_;
  AeroelasticResiduals best_residuals_;
  double best_merit_ = std::numeric_limits<double>::infinity();
  int steps_since_best_ = 0;
  std::vector<double> forces_, residual_;
  StaggeredResult result_;
  int begun_ = 0;            // iterations of an earlier run
  bool is_resumed_ = false;  // the next state to look at is one that run has seen
};

template <int Dim>
void Staggered<Dim>::go_on(const CycleAmplitude& amplitude, const StaggeredMemory& earlier) {
  result_.iterations = begun_ = earlier.iterations;
  result_.flow_cycles = earlier.flow_cycles;
  result_.recoveries = earlier.recoveries;
  steps_since_best_ = earlier.steps_since_best;
  settled_steps_ = earlier.settled_steps;
  relaxation_ = earlier.relaxation;
  energy_ = earlier.energy;
  previous_r_ = earlier.previous_r;
  start_omega_ = earlier.start_omega;
  start_r_ = earlier.start_r;
  if (const auto* speed = std::get_if<GivenSpeed>(&amplitude))
    search_.emplace(r_of(*speed), energy_, earlier.last_point);
  best_ = earlier.best;
  best_residuals_ = earlier.best_residuals;
  best_merit_ = merit(best_residuals_);
  is_resumed_ = true;
}

template <int Dim>
StaggeredMemory Staggered<Dim>::memory() const {
  StaggeredMemory kept;
  kept.iterations = result_.iterations;
  kept.flow_cycles = result_.flow_cycles;
  kept.recoveries = result_.recoveries;
  kept.steps_since_best = steps_since_best_;
  kept.settled_steps = settled_steps_;
  kept.relaxation = relaxation_;
  kept.energy = energy_;
  kept.previous_r = previous_r_;
  kept.start_omega = start_omega_;
  kept.start_r = start_r_;
  if (search_) kept.last_point = search_->last();
  kept.best = best_;
  kept.best_residuals = best_residuals_;
  return kept;
}

template <int Dim>
void Staggered<Dim>::normalize(std::vector<double>& y) const {
  y = scaled_to_energy(structure_.model(), y, energy_);
  y = shifted_to_phase(structure_.model(), structure_.time(), y);
}

template <int Dim>
std::vector<MotionState> Staggered<Dim>::motions() const {
  std::vector<MotionState> moved;
  for (std::size_t n = 0; n < flow_.instance_count(); ++n)
    moved.push_back(kinematics_.motion(std::span<const double>(state_.y).subspan(4 * n, 4), state_.r));
  return moved;
}

template <int Dim>
void Staggered<Dim>::advance_flow() {
  const std::vector<MotionState> moved = motions();
  const double kappa = kinematics_.kappa(state_.omega, state_.r);
  for (int i = 0; i < options_.flow_cycles; ++i) cycle_(state_.w, moved, kappa);
  result_.flow_cycles += options_.flow_cycles;
}

template <int Dim>
bool Staggered<Dim>::measure() {
  const bool is_sane = is_physical<Dim>(state_.w, flow_.model().freestream.gamma) &&
                       is_within(state_.omega, start_omega_) && is_within(state_.r, start_r_);
  if (comm_.any(!is_sane)) return false;
  const std::vector<MotionState> moved = motions();
  residual_.resize(flow_.state_count());
  flow_.residual(state_.w, moved, kinematics_.kappa(state_.omega, state_.r), residual_);
  const double local = norm(residual_);
  AeroelasticResiduals& residuals = result_.residuals;
  residuals.flow = std::sqrt(comm_.sum(local * local)) / uniform_residual_;

  forces_.clear();
  for (const Loads<double>& loads : flow_.loads(state_.w, moved))
    forces_.insert(forces_.end(), {-loads.force_y, 2.0 * loads.moment});
  std::vector<double> s(state_.y.size());
  structure_.residual(state_.y, state_.omega, structure_.model().load(kinematics_.reduced_velocity(state_.r)),
                      forces_, s);
  const double scale = std::sqrt(energy_);
  residuals.structure = norm(s) / scale;
  residuals.phase = std::abs(value(AmplitudeCondition(phase_), state_.y)) / scale;
  residuals.energy = search_ ? std::abs(search_->mismatch(state_.r))
                             : std::abs(fluctuating_energy(structure_.model(), state_.y) / energy_ - 1.0);
  return std::isfinite(merit(residuals));
}

template <int Dim>
void Staggered<Dim>::keep_best() {
  const double now = merit(result_.residuals);
  if (now < best_merit_) {
    best_merit_ = now;
    best_residuals_ = result_.residuals;
    best_ = state_;
    steps_since_best_ = 0;
  } else {
    ++steps_since_best_;
  }
}

// The largest residual in units of its tolerance.
template <int Dim>
double Staggered<Dim>::merit(const AeroelasticResiduals& r) const {
  const double structure = r.structure / options_.tolerances.structure;
  return std::max(r.flow / options_.tolerances.flow, structure);
}

template <int Dim>
bool Staggered<Dim>::is_converged() const {
  const AeroelasticResiduals& r = result_.residuals;
  return r.flow <= options_.tolerances.flow &&
         std::max({r.structure, r.phase, r.energy}) <= options_.tolerances.structure;
}

template <int Dim>
void Staggered<Dim>::take_structural_step() {
  const double load = structure_.model().load(kinematics_.reduced_velocity(state_.r));
  const double dtau = options_.pseudo_time_step * 2.0 * std::numbers::pi / state_.omega;
  std::vector<double> y = structural_step(structure_, state_.y, state_.omega, load, forces_, dtau);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = state_.y[i] + relaxation_ * (y[i] - state_.y[i]);
  normalize(y);
  state_.y = std::move(y);
  if ((result_.iterations + 1) % options_.frequency_interval != 0) return;
  const FrequencyAndLoad fitted = fitted_frequency_and_load(structure_, state_.y, forces_);
  const double r = fitted.load / structure_.model().load(kinematics_.reduced_velocity(1.0));
  state_.omega =
      limited(state_.omega + relaxation_ * (fitted.omega - state_.omega), state_.omega, largest_change);
  state_.r = limited(state_.r + relaxation_ * (r - state_.r), state_.r, largest_change * largest_change);
}

template <int Dim>
void Staggered<Dim>::advance_structure() {
  std::vector<double> sent(state_.y.size() + 2, std::numeric_limits<double>::quiet_NaN());
  if (comm_.is_root()) {
    try {
      take_structural_step();
      std::copy(state_.y.begin(), state_.y.end(), sent.begin());
      sent[sent.size() - 2] = state_.omega;
      sent[sent.size() - 1] = state_.r;
    } catch (const InputError&) {
      // The phase mode has come to rest: every rank finds numbers that make no sense, and recovers.
    }
  }
  comm_.broadcast(sent);
  state_.omega = sent[sent.size() - 2];
  state_.r = sent[sent.size() - 1];
  sent.resize(state_.y.size());
  state_.y = std::move(sent);
}

// Moves on along the branch once r of the present energy is known much better than how far it is
// from the target. The flow is scaled along, lest it answer for the old amplitude.
template <int Dim>
void Staggered<Dim>::advance_energy() {
  const double distance = std::abs(search_->mismatch(state_.r));
  const double change = std::abs(state_.r - previous_r_) / search_->target_r();
  previous_r_ = state_.r;
  const bool is_settled =
      change <= settled_change * distance && result_.residuals.structure <= settled_residual * distance;
  settled_steps_ = is_settled ? settled_steps_ + 1 : 0;
  if (settled_steps_ < steps_to_settle || distance <= options_.tolerances.structure) return;
  search_->advance(state_.r);
  const double factor = std::sqrt(search_->energy() / energy_);
  energy_ = search_->energy();
  normalize(state_.y);
  scale_fluctuation(state_.w, flow_.instance_count(), factor);
  settled_steps_ = 0;
  best_merit_ = std::numeric_limits<double>::infinity();
}

template <int Dim>
bool Staggered<Dim>::recover() {
  if (result_.recoveries == options_.max_recoveries) return false;
  ++result_.recoveries;
  relaxation_ *= 0.5;
  steps_since_best_ = 0;
  state_ = best_;
  return true;
}

template <int Dim>
StaggeredResult Staggered<Dim>::solve(const StaggeredObserver& observer) {
  for (;; ++result_.iterations) {
    if (result_.iterations > 0 && !is_resumed_) advance_flow();
    const bool is_sane = measure();
    if (is_sane && !is_resumed_) keep_best();
    is_resumed_ = false;
    if (!is_sane || steps_since_best_ > patience) {
      if (recover()) continue;
      result_.status = is_sane ? SolveStatus::stalled : SolveStatus::diverged;
      break;
    }
    const double v = kinematics_.reduced_velocity(state_.r);
    const bool goes_on = !observer || observer({result_.iterations, result_.residuals, state_.omega, v,
                                                energy_, relaxation_, [this] { return memory(); }});
    if (is_converged()) {
      result_.status = SolveStatus::converged;
      return result_;
    }
    if (!goes_on) {
      result_.status = SolveStatus::interrupted;
      result_.memory = memory();
      return result_;
    }
    if (result_.iterations - begun_ == options_.max_iterations) break;
    if (search_ && result_.iterations > 0) advance_energy();
    advance_structure();
  }
  state_ = best_;
  measure();
  return result_;
}

}  // namespace

template <int Dim>
StaggeredResult solve_staggered(const FlowCycle& cycle, FlowEquations<Dim>& flow,
                                const StructuralEquation& structure, const SectionKinematics& kinematics,
                                const CycleAmplitude& amplitude, AeroelasticState& state,
                                const StaggeredOptions& options, const StaggeredObserver& observer,
                                const StaggeredMemory* earlier) {
  return Staggered<Dim>(cycle, flow, structure, kinematics, amplitude, options, state, earlier)
      .solve(observer);
}

template StaggeredResult solve_staggered<2>(const FlowCycle&, FlowEquations<2>&, const StructuralEquation&,
                                            const SectionKinematics&, const CycleAmplitude&,
                                            AeroelasticState&, const StaggeredOptions&,
                                            const StaggeredObserver&, const StaggeredMemory*);
template StaggeredResult solve_staggered<3>(const FlowCycle&, FlowEquations<3>&, const StructuralEquation&,
                                            const SectionKinematics&, const CycleAmplitude&,
                                            AeroelasticState&, const StaggeredOptions&,
                                            const StaggeredObserver&, const StaggeredMemory*);

}  // namespace wingbeat
