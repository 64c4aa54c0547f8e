#include "apps/analysis_setup.hpp"

#include <algorithm>

#include "apps/flow_setup.hpp"

namespace wingbeat {

DomainBase<2> domain_base(const Context& context, const FlowLevel<2>& level, const ShapeVariables& shape) {
  return {context.comm,         level.local,         shape.nodes(),
          level.steady.model(), level.domain.axis(), has_structure(context.settings)};
}

NewtonOptions near_options(const SolverSettings& settings) {
  NewtonOptions options;
  // Where these do not do the start is too far away: shorter steps lead there sooner.
  options.max_iterations = std::min(settings.max_newton_iterations, 12);
  options.gmres = gmres_options(settings);
  return options;
}

double primal_tolerance(const Context& context, double tolerance, double round_off) {
  return context.check ? std::min(round_off, tolerance) : tolerance;
}

}  // namespace wingbeat
