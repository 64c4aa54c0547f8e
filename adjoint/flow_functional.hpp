#pragma once

#include "adjoint/functional.hpp"
#include "adjoint/load_functional.hpp"

namespace wingbeat {

// Loads of a flow about a given motion, steady (one instance) or periodic: F = R(w).
template <int Dim>
class FlowFunctional final : public Functional<Dim> {
 public:
  // `flow` is linearized at `at`, where `problem` is solved; all are kept by reference.
  FlowFunctional(FlowEquations<Dim>& flow, const Problem& problem, const FlowPoint& at,
                 LoadFunctional objective);

  const Comm& comm() const override { return flow_.domain().comm(); }
  const Problem& problem() const override { return problem_; }
  FlowPoint point() const override { return at_; }
  double value() const override { return objective_.value(loads_); }
  std::vector<double> by_state() const override;
  InputTangent tangent(const Inputs<Dim>& change) const override;
  Inputs<Dim> sensitivity(std::span<const double> multipliers) const override;

 private:
  FlowEquations<Dim>& flow_;
  const Problem& problem_;
  FlowPoint at_;
  LoadFunctional objective_;
  std::vector<Loads<double>> loads_;
};

}  // namespace wingbeat
