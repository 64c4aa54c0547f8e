#include "optimize/design_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "adjoint/objective.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

constexpr std::size_t kept_solutions = 6;

std::vector<double> scales_of(const DesignVariables& variables) {
  std::vector<double> scales;
  for (std::size_t i = 0; i < variables.size(); ++i) scales.push_back(variables.scale(i));
  return scales;
}

std::vector<double> between(std::span<const double> a, std::span<const double> b, double t) {
  std::vector<double> x(a.begin(), a.end());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += t * (b[i] - a[i]);
  return x;
}

}  // namespace

DesignSolver::DesignSolver(const Comm& comm, OutputAnalysis analysis, std::vector<double> design,
                           const DesignVariables& variables, const ShapeVariables& shape,
                           const DesignSolverOptions& options)
    : comm_(comm),
      analysis_(std::move(analysis)),
      variables_(variables),
      shape_(shape),
      options_(options),
      starts_(scales_of(variables), kept_solutions),
      at_(std::move(design)) {
  starts_.add(at_, analysis_.analysis->solution());
}

DesignCost DesignSolver::solve(std::span<const double> design) {
  const auto begun = std::chrono::steady_clock::now();
  DesignCost cost;
  const WarmStarts::Start from = starts_.nearest(design);
  for (int bisections = 0;; ++bisections) {
    try {
      const int steps = 1 << bisections;
      WarmStarts::Start start = from;
      for (int i = 1; i <= steps; ++i) {
        const auto next = i == steps ? std::vector<double>(design.begin(), design.end())
                                     : between(from.design, design, static_cast<double>(i) / steps);
        ++cost.solves;
        solve_from(start, next);
        start = {next, analysis_.analysis->solution()};
      }
      break;
    } catch (const SolveFailure& failure) {
      if (failure.status() == SolveStatus::interrupted) throw;
      if (bisections >= options_.max_bisections)
        throw SolveFailure(failure.status(), fmt::format("{}: {} (after {} halvings of the way from the "
                                                         "nearest design solved)",
                                                         name(), failure.what(), bisections));
    }
  }
  cost.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return cost;
}

void DesignSolver::solve_from(const WarmStarts::Start& start, std::span<const double> design) {
  at_.clear();
  analysis_.analysis->start_from(start.solution);
  analysis_.analysis->solve(variables_.change(design));
  at_.assign(design.begin(), design.end());
  starts_.add(design, analysis_.analysis->solution());
}

std::vector<double> DesignSolver::values() const {
  ensure(!at_.empty(), "the design is not solved");
  std::vector<double> result;
  for (const AnalysisOutput& output : analysis_.outputs) {
    output.choose();
    result.push_back(analysis_.analysis->functional().value());
  }
  return result;
}

std::vector<std::vector<double>> DesignSolver::gradients(std::span<const double> design) {
  if (!std::ranges::equal(at_, design)) solve(design);
  std::vector<std::vector<double>> result;
  for (const AnalysisOutput& output : analysis_.outputs) {
    output.choose();
    result.push_back(derivatives());
  }
  return result;
}

std::vector<double> DesignSolver::derivatives() {
  Analysis<2>& analysis = *analysis_.analysis;
  int factorizations = 0;
  const AdjointSolution adjoint = solve_adjoint(analysis, options_.gmres, factorizations);
  if (!is_near(adjoint.solve, options_.gmres))
    throw SolveFailure(
        SolveStatus::stalled,
        fmt::format("{}: the adjoint equations were solved to {:.1e}, not to "
                    "gradient.tolerance = {:g}",
                    name(), adjoint.solve.relative_residual, options_.gmres.relative_tolerance));
  const auto sensitivity = total_derivative(analysis.functional(), analysis.point(), adjoint);
  return variables_.derivatives(shape_.wall_sensitivity(comm_, sensitivity.nodes), sensitivity);
}

}  // namespace wingbeat
