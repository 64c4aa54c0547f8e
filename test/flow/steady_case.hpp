#pragma once

#include "flow/pseudo_transient.hpp"
#include "test/flow/flow_case.hpp"

namespace wingbeat::testing {

// A steady flow about a section at rest, solved from free stream. Loads in wind axes.
struct SteadySolution {
  PseudoTransientResult result;
  std::vector<double> w;
  double lift = 0.0;
  double drag = 0.0;
  double moment = 0.0;  // nose up about the quarter chord
};

// Tolerance: 11.5 orders. With a far field 60 chords away the round-off of its large faces leaves a
// floor of about 1e-12 of the residual of uniform flow.
inline SteadySolution solve_steady(const FlowCase<2>& c, double tolerance = 3.2e-12) {
  FlowEquations<2> flow(c.domain, c.model, TimeSpectral(0));
  const auto subdomain = std::make_shared<const Subdomain>(c.comm, c.domain.exchange(), c.domain.pattern(),
                                                           SubdomainOptions{.overlap = 3});
  SchwarzSolver<double> solver(c.comm, subdomain, state_size<2>);
  SteadySolution solution;
  solution.w = flow.uniform_state();
  PseudoTransientOptions options;
  options.tolerance = tolerance;
  solution.result = pseudo_transient<2>(flow, {}, solver, solution.w, options);

  const MotionState at_rest;
  const Loads<double> loads = flow.loads(solution.w, {&at_rest, 1})[0];
  const auto& stream = c.model.freestream;
  solution.lift = loads.force_y * stream.angle_cosine - loads.force_x * stream.angle_sine;
  solution.drag = loads.force_x * stream.angle_cosine + loads.force_y * stream.angle_sine;
  solution.moment = loads.moment + (0.25 - c.domain.axis()[0]) * loads.force_y;
  return solution;
}

}  // namespace wingbeat::testing
