#pragma once

#include <memory>
#include <optional>

#include "adjoint/analysis.hpp"
#include "adjoint/changed_domain.hpp"
#include "adjoint/cycle_functional.hpp"

namespace wingbeat {

// Which cycle is meant whatever the parameters are, and which number of it.
struct CycleAnalysisOptions {
  CycleQuantity quantity = CycleQuantity::speed;
  double energy = 1e-6;                      // E_0: given, or near that of the cycle where its speed is given
  std::optional<double> reduced_velocity{};  // the speed where that is given
  AeroelasticTolerances tolerances{1e-12, 1e-12};  // aimed at
  double slack = 100.0;                            // times the tolerances are accepted
  NewtonOptions newton{};
};

// A flutter point or limit cycle of a typical section.
template <int Dim>
class CycleAnalysis final : public Analysis<Dim> {
 public:
  // `start`: the base's solution; `rest`: one instance that its amplitude is measured from; `factors`: of
  // matrices near its Jacobian's.
  CycleAnalysis(const DomainBase<Dim>& base, const TypicalSection& section, double mean_pitch,
                AeroelasticState start, AeroelasticState rest, HarmonicFactors factors,
                const CycleAnalysisOptions& options);

  void solve(const Parameters<Dim>& change) override;
  const Functional<Dim>& functional() const override { return *functional_; }
  ParameterPoint<Dim> point() const override;
  void refactor() override { problem_->refactor(); }
  std::vector<double> solution() const override;
  void start_from(std::span<const double> solution) override;
  const AeroelasticState& state() const { return state_; }
  // Another number of the same cycle from now on.
  void choose(CycleQuantity quantity);

 private:
  void make_functional();
  CycleCondition condition(const StructureModel& model) const;

  DomainBase<Dim> base_;
  TypicalSection section_;
  double mean_pitch_;
  AeroelasticState start_;
  AeroelasticState rest_;
  HarmonicFactors factors_;
  CycleAnalysisOptions options_;
  TimeSpectral time_;
  // Of the last solution.
  AeroelasticState state_;
  TypicalSection changed_section_;
  std::unique_ptr<ChangedDomain<Dim>> at_;
  std::vector<double> u_;
  std::unique_ptr<AeroelasticProblem<Dim>> problem_;
  std::unique_ptr<CycleFunctional<Dim>> functional_;
};

}  // namespace wingbeat
