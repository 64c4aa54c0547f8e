#pragma once

#include <optional>

#include "adjoint/analysis.hpp"
#include "adjoint/changed_domain.hpp"
#include "adjoint/flow_functional.hpp"
#include "flow/forced_flow_problem.hpp"
#include "flow/forced_motion.hpp"

namespace wingbeat {

// A sum of numbers of the loads.
struct WeightedLoad {
  double weight = 1.0;
  LoadQuantity quantity;
};

struct FlowAnalysisOptions {
  std::vector<WeightedLoad> objective;
  std::optional<Vec<double, 2>> moment_reference{};  // chords; the axis if not given
  double tolerance = 1e-12;                          // aimed at: |R| relative to that of uniform flow
  double slack = 100.0;                              // times the tolerance are accepted
  NewtonOptions newton{};
};

// Steady flow (one instance), or periodic flow about a prescribed motion, and a number of its loads.
template <int Dim>
class FlowAnalysis final : public Analysis<Dim> {
 public:
  // `start`: the base's solution, `factors`: of matrices near its Jacobian's. The reduced frequency k is kept
  // as the free stream changes.
  FlowAnalysis(const DomainBase<Dim>& base, const TimeSpectral& time, ForcedMotion motion,
               double reduced_frequency, std::vector<double> start, HarmonicFactors factors,
               FlowAnalysisOptions options);

  void solve(const Parameters<Dim>& change) override;
  const Functional<Dim>& functional() const override { return *functional_; }
  ParameterPoint<Dim> point() const override;
  void refactor() override { problem_->refactor(); }
  std::vector<double> solution() const override { return w_; }
  void start_from(std::span<const double> solution) override {
    start_.assign(solution.begin(), solution.end());
  }
  // Another number of the same loads from now on.
  void choose(std::vector<WeightedLoad> objective);

 private:
  void make_functional();

  DomainBase<Dim> base_;
  TimeSpectral time_;
  ForcedMotion motion_;
  double reduced_frequency_;
  std::vector<double> start_;
  HarmonicFactors factors_;
  FlowAnalysisOptions options_;
  // Of the last solution.
  std::vector<double> w_;
  std::unique_ptr<ChangedDomain<Dim>> at_;
  std::vector<MotionState> motions_;
  double kappa_ = 0.0;
  std::unique_ptr<ForcedFlowProblem<Dim>> problem_;
  std::unique_ptr<FlowFunctional<Dim>> functional_;
};

}  // namespace wingbeat
