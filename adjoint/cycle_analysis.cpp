#include "adjoint/cycle_analysis.hpp"

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

TypicalSection moved(TypicalSection section, const std::array<double, scalar_count>& change) {
  const auto by = [&](Scalar s) { return change[static_cast<std::size_t>(s)]; };
  section.elastic_axis += by(Scalar::elastic_axis);
  section.static_unbalance += by(Scalar::static_unbalance);
  section.gyration_radius_squared += by(Scalar::gyration_radius_squared);
  section.frequency_ratio += by(Scalar::frequency_ratio);
  section.mass_ratio += by(Scalar::mass_ratio);
  return section;
}

int harmonics_of(const AeroelasticState& state) {
  constexpr std::size_t states = 4;  // of a section, an instance
  return static_cast<int>(state.y.size() / states - 1) / 2;
}

}  // namespace

template <int Dim>
CycleAnalysis<Dim>::CycleAnalysis(const DomainBase<Dim>& base, const TypicalSection& section,
                                  double mean_pitch, AeroelasticState start, AeroelasticState rest,
                                  HarmonicFactors factors, const CycleAnalysisOptions& options)
    : base_(base),
      section_(section),
      mean_pitch_(mean_pitch),
      start_(std::move(start)),
      rest_(std::move(rest)),
      factors_(std::move(factors)),
      options_(options),
      time_(harmonics_of(start_)),
      changed_section_(section) {}

template <int Dim>
CycleCondition CycleAnalysis<Dim>::condition(const StructureModel& model) const {
  CycleCondition condition(energy_condition(model, options_.energy));
  if (options_.reduced_velocity) {
    condition.by_energy = 0.0;
    condition.by_speed = 1.0;
    condition.reduced_velocity = *options_.reduced_velocity;
  }
  return condition;
}

template <int Dim>
void CycleAnalysis<Dim>::solve(const Parameters<Dim>& change) {
  functional_.reset();
  problem_.reset();
  at_ = std::make_unique<ChangedDomain<Dim>>(base_, change, time_);
  changed_section_ = moved(section_, change.scalars);
  const StructureModel model = structure_model(changed_section_);
  SectionKinematics kinematics;
  kinematics.flow_speed = at_->model.freestream.speed();
  kinematics.mean_pitch = mean_pitch_;
  const CycleCondition row = condition(model);
  problem_ = std::make_unique<AeroelasticProblem<Dim>>(at_->flow, StructuralEquation(model, time_),
                                                       kinematics, row, rest_, factors_, options_.tolerances);
  u_ = problem_->unknowns(start_);
  solve_near_roundoff(base_.comm, *problem_, u_, options_.newton, options_.slack, "the cycle");
  state_ = problem_->state(u_);
  if (is_at_rest(row, state_.y))
    throw SolveFailure(SolveStatus::stalled, "no cycle was found at the given speed and changed parameters");
  problem_->linearize(u_);
  if (!problem_->is_factored()) problem_->refactor();
  make_functional();
}

// w, y, omega, r.
template <int Dim>
std::vector<double> CycleAnalysis<Dim>::solution() const {
  std::vector<double> packed = state_.w;
  packed.insert(packed.end(), state_.y.begin(), state_.y.end());
  packed.insert(packed.end(), {state_.omega, state_.r});
  return packed;
}

template <int Dim>
void CycleAnalysis<Dim>::start_from(std::span<const double> solution) {
  const std::size_t cells = start_.w.size(), rest = start_.y.size() + 2;
  ensure(solution.size() == cells + rest, "a cycle of another size");
  start_.w.assign(solution.begin(), solution.begin() + static_cast<std::ptrdiff_t>(cells));
  start_.y.assign(solution.begin() + static_cast<std::ptrdiff_t>(cells), solution.end() - 2);
  start_.omega = solution[solution.size() - 2];
  start_.r = solution.back();
}

template <int Dim>
void CycleAnalysis<Dim>::choose(CycleQuantity quantity) {
  options_.quantity = quantity;
  if (problem_) make_functional();
}

template <int Dim>
void CycleAnalysis<Dim>::make_functional() {
  functional_ =
      std::make_unique<CycleFunctional<Dim>>(*problem_, changed_section_, state_, options_.quantity);
}

template <int Dim>
ParameterPoint<Dim> CycleAnalysis<Dim>::point() const {
  return {at_->mesh, base_.nodes, at_->flow, functional_->point(), base_.turns_about_elastic_axis};
}

template class CycleAnalysis<2>;
template class CycleAnalysis<3>;

}  // namespace wingbeat
