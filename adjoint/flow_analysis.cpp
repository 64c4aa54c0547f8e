#include "adjoint/flow_analysis.hpp"

#include <cmath>

namespace wingbeat {

template <int Dim>
FlowAnalysis<Dim>::FlowAnalysis(const DomainBase<Dim>& base, const TimeSpectral& time, ForcedMotion motion,
                                double reduced_frequency, std::vector<double> start, HarmonicFactors factors,
                                FlowAnalysisOptions options)
    : base_(base),
      time_(time),
      motion_(std::move(motion)),
      reduced_frequency_(reduced_frequency),
      start_(std::move(start)),
      factors_(std::move(factors)),
      options_(std::move(options)) {}

template <int Dim>
void FlowAnalysis<Dim>::solve(const Parameters<Dim>& change) {
  functional_.reset();
  problem_.reset();
  at_ = std::make_unique<ChangedDomain<Dim>>(base_, change, time_);
  kappa_ = 2.0 * reduced_frequency_ * at_->model.freestream.speed();
  motions_ = motions_of(motion_, time_, kappa_);
  problem_ =
      std::make_unique<ForcedFlowProblem<Dim>>(at_->flow, motions_, kappa_, factors_, options_.tolerance);
  w_ = start_;
  solve_near_roundoff(base_.comm, *problem_, w_, options_.newton, options_.slack, "the flow");
  at_->flow.linearize(w_, motions_, kappa_);
  if (!problem_->is_factored()) problem_->refactor();
  make_functional();
}

template <int Dim>
void FlowAnalysis<Dim>::choose(std::vector<WeightedLoad> objective) {
  options_.objective = std::move(objective);
  if (problem_) make_functional();
}

template <int Dim>
void FlowAnalysis<Dim>::make_functional() {
  const auto& freestream = at_->model.freestream;
  const double angle = std::atan2(freestream.angle_sine, freestream.angle_cosine);
  LoadFunctional sum;
  for (const auto& [weight, quantity] : options_.objective)
    add_scaled(
        weight,
        load_functional(quantity, time_, angle, motions_, at_->domain.axis(), options_.moment_reference),
        sum);
  functional_ = std::make_unique<FlowFunctional<Dim>>(at_->flow, *problem_, FlowPoint{w_, motions_, kappa_},
                                                      std::move(sum));
}

template <int Dim>
ParameterPoint<Dim> FlowAnalysis<Dim>::point() const {
  return {at_->mesh, base_.nodes, at_->flow, {w_, motions_, kappa_}, base_.turns_about_elastic_axis};
}

template class FlowAnalysis<2>;
template class FlowAnalysis<3>;

}  // namespace wingbeat
