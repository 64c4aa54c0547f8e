#pragma once

#include <memory>
#include <numbers>

#include "adjoint/cycle_analysis.hpp"
#include "adjoint/flow_analysis.hpp"
#include "adjoint/shape_variables.hpp"
#include "test/structure/coupled_case.hpp"

namespace wingbeat::testing {

// The shape variables of a small case, on its ranks.
inline ShapeVariables shape_of(const FlowCase<2>& c) { return {c.mesh, c.local, DesignSettings{}}; }

// The paper's section in small motion at its flutter point or in a limit cycle, as an analysis over all
// parameters.
struct CycleCase {
  CoupledCase c;
  FlutterSolution flutter;
  ShapeVariables shape;
  DomainBase<2> base;
  std::vector<double> steady;

  CycleCase(MultiblockMesh<2> mesh, int harmonics, double energy, const Comm& ranks = Comm())
      : c(std::move(mesh), 0.8, harmonics, ranks), shape(shape_of(c.flow_case)), base(domain_base()) {
    NewtonOptions options;
    flutter = solve_flutter(c, energy, options);
    if (flutter.newton.status != SolveStatus::converged) throw std::runtime_error("flutter: not converged");
    steady = steady_state(c);
  }
  DomainBase<2> domain_base() const {
    return {c.flow_case.comm, c.flow_case.local, shape.nodes(), c.flow_case.model, {{{0.2, 0.0}}}, true};
  }

  CycleAnalysis<2> analysis(const CycleAnalysisOptions& options) const {
    return {base,      paper_section, 0.0, flutter.state, {steady, std::vector<double>(4, 0.0), 0.0, 1.0},
            c.factors, options};
  }
};

// Steady flow, or flow about a forced pitch, as an analysis.
struct LoadCase {
  CoupledCase c;
  ShapeVariables shape;
  DomainBase<2> base;
  std::vector<double> w;  // of every instance: steady

  LoadCase(MultiblockMesh<2> mesh, double mach, int harmonics, const Comm& ranks = Comm())
      : c(std::move(mesh), mach, harmonics, ranks),
        shape(shape_of(c.flow_case)),
        base{c.flow_case.comm, c.flow_case.local, shape.nodes(), c.flow_case.model, {{{0.2, 0.0}}}, true} {
    const std::vector<double> one = steady_state(c);
    for (int n = 0; n < c.time.instances(); ++n) w.insert(w.end(), one.begin(), one.end());
  }
  FlowAnalysis<2> analysis(const LoadQuantity& quantity, ForcedMotion motion = {}, double k = 0.0,
                           std::optional<Vec<double, 2>> reference = {}) const {
    return {base, c.time, std::move(motion), k, w, c.factors, {{{1.0, quantity}}, reference}};
  }
};

// A direction in all parameters at once, the same on any ranks: bumps and single numbers.
inline Parameters<2> direction(const ShapeVariables& shape, double shape_size, double scalar_size) {
  std::vector<double> amplitudes;
  for (int i = 0; i < shape.bumps().variables(); ++i)
    amplitudes.push_back(shape_size * std::sin(1.0 + 2.3 * i));
  Parameters<2> change;
  change.nodes = shape.node_change(amplitudes);
  change[Scalar::mach] = 0.1 * scalar_size;
  change[Scalar::angle_of_attack] = 2.0 * scalar_size;
  change[Scalar::elastic_axis] = -0.4 * scalar_size;
  change[Scalar::static_unbalance] = 0.3 * scalar_size;
  change[Scalar::gyration_radius_squared] = -0.2 * scalar_size;
  change[Scalar::frequency_ratio] = 0.25 * scalar_size;
  change[Scalar::mass_ratio] = 40.0 * scalar_size;
  return change;
}

// sensitivities . change; those to nodes are parts that add up over ranks.
inline double parameter_dot(const Comm& comm, const Parameters<2>& sensitivity, const Parameters<2>& change) {
  double nodes = 0.0, scalars = 0.0;
  for (std::size_t i = 0; i < change.nodes.size(); ++i) nodes += dot(sensitivity.nodes[i], change.nodes[i]);
  for (std::size_t k = 0; k < scalar_count; ++k) scalars += sensitivity.scalars[k] * change.scalars[k];
  return comm.sum(nodes) + scalars;
}

// As far as round-off allows: derivatives with respect to what moves the mean flow are sums of terms a
// thousand times greater where the motion is small.
inline GmresOptions tight() { return {.relative_tolerance = 1e-14, .restart = 200, .max_iterations = 1000}; }

inline Parameters<2> adjoint_gradient(const Analysis<2>& analysis) {
  const Functional<2>& functional = analysis.functional();
  const AdjointSolution adjoint =
      solve_adjoint(functional.comm(), functional.problem(), functional.by_state(), tight());
  EXPECT_LT(adjoint.solve.relative_residual, 1e-12);
  return total_derivative(functional, analysis.point(), adjoint);
}

}  // namespace wingbeat::testing
