// Checks that can fail: a term of the derivative left out on purpose is seen by tangent and differences.
#include <gtest/gtest.h>

#include "flow/flow_sensitivity.hpp"
#include "test/adjoint/analysis_cases.hpp"

namespace wingbeat::testing {
namespace {

// Which term is left out of a functional's sensitivities or of the adjoint's Jacobian.
enum class Missing { nothing, flow_by_r, force_geometry, grid_velocity, time_term };

// The coupled Jacobian without dR/dr: its column is that of the last unknown, on rank 0.
class WithoutFlowByR final : public LinearOperator<double> {
 public:
  WithoutFlowByR(const LinearOperator<double>& full, std::size_t flow_size, const Comm& comm)
      : full_(full), flow_size_(flow_size), comm_(comm) {}
  std::size_t local_size() const override { return full_.local_size(); }
  void apply(std::span<const double> x, std::span<double> y) const override {
    std::vector<double> without(x.begin(), x.end()), column(x.size()), unit(x.size(), 0.0);
    full_.apply(x, y);
    double last = 0.0;
    if (comm_.is_root()) {
      unit.back() = 1.0;
      last = x.back();
    }
    comm_.broadcast(last);
    full_.apply(unit, column);
    for (std::size_t i = 0; i < flow_size_; ++i) y[i] -= last * column[i];
  }
  void apply_transpose(std::span<const double> x, std::span<double> y) const override {
    full_.apply_transpose(x, y);
    std::vector<double> unit(x.size(), 0.0), column(x.size());
    if (comm_.is_root()) unit.back() = 1.0;
    full_.apply(unit, column);
    double product = 0.0;
    for (std::size_t i = 0; i < flow_size_; ++i) product += column[i] * x[i];
    product = comm_.sum(product);
    if (comm_.is_root()) y.back() -= product;
  }

 private:
  const LinearOperator<double>& full_;
  std::size_t flow_size_;
  Comm comm_;
};

double derivative_without(const CycleCase& c, const CycleAnalysis<2>& analysis, Missing missing,
                          const Parameters<2>& change) {
  const Functional<2>& functional = analysis.functional();
  const Problem& problem = functional.problem();
  const WithoutFlowByR reduced(problem.jacobian(), c.c.flow.state_count(), functional.comm());
  const LinearOperator<double>& jacobian = missing == Missing::flow_by_r
                                               ? static_cast<const LinearOperator<double>&>(reduced)
                                               : problem.jacobian();
  std::vector<double> rhs = functional.by_state(), lambda(rhs.size(), 0.0);
  for (double& value : rhs) value = -value;
  gmres<double>(functional.comm(), TransposedOperator<double>(jacobian),
                TransposedOperator<double>(problem.preconditioner()), rhs, lambda, tight());
  Inputs<2> inputs = functional.sensitivity(lambda);
  if (missing == Missing::force_geometry) {
    // The flow's rows alone: forces then do not know that the wall turns.
    const auto& flow = analysis.point().flow;
    const auto& problem_of_cycle = dynamic_cast<const AeroelasticProblem<2>&>(problem);
    const std::vector<Loads<double>> none(flow.instance_count());
    inputs.flow =
        flow_sensitivity<2>(flow, functional.point(), problem_of_cycle.multipliers(lambda).flow, none);
  }
  if (missing == Missing::grid_velocity)
    for (auto& block : inputs.flow.geometry)
      for (auto& values : block.moment) std::fill(values.begin(), values.end(), 0.0);
  if (missing == Missing::time_term)
    for (auto& block : inputs.flow.geometry) std::fill(block.volume.begin(), block.volume.end(), 0.0);
  return parameter_dot(functional.comm(), parameter_sensitivity(analysis.point(), inputs), change);
}

TEST(WrongTerms, AreSeenByTheTangentAndItsAbsenceIsNot) {
  const CycleCase c(section_mesh("naca64a010", 64, 16), 1, 1e-4);
  CycleAnalysis<2> analysis = c.analysis({.energy = 1e-4});
  analysis.solve(no_change<2>(c.shape.nodes()));
  const Parameters<2> change = direction(c.shape, 1.0, 0.0);
  const double exact = directional_derivative(analysis.functional(), analysis.point(), change, tight()).value;
  const auto error = [&](Missing missing) {
    return std::abs(derivative_without(c, analysis, missing, change) / exact - 1.0);
  };
  EXPECT_LT(error(Missing::nothing), 1e-9);
  for (const auto& [missing, name] : {std::pair{Missing::flow_by_r, "dR/dr"},
                                      {Missing::force_geometry, "geometry of forces"},
                                      {Missing::grid_velocity, "grid velocity"},
                                      {Missing::time_term, "volumes under the time derivative"}}) {
    const double found = error(missing);
    RecordProperty(name, std::to_string(found));
    EXPECT_GT(found, 1e-5) << name << ": a check to 1e-6 would not see it";
    if (Comm().is_root()) printf("  without %-34s the gradient is wrong by %.2e of itself\n", name, found);
  }
}

}  // namespace
}  // namespace wingbeat::testing
