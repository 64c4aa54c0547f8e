#pragma once

#include "flow/forced_motion.hpp"
#include "flow/pseudo_time.hpp"
#include "test/flow/flow_case.hpp"

namespace wingbeat::testing {

// A section, steady or pitching about its quarter chord, on a mesh cut so that it can be coarsened.
struct MultigridCase {
  Comm comm;
  MultiblockMesh<2> mesh;
  Partition<2> partition;
  LocalMesh<2> local;
  FlowDomain<2> domain;
  FlowEquations<2> flow;
  double kappa;
  std::vector<MotionState> motions;

  // `reduced_frequency` on the semichord, `amplitude_deg` of the pitch; at rest without harmonics.
  MultigridCase(MultiblockMesh<2> m, double mach, double angle_deg,
                const TimeSpectral& time = TimeSpectral(0), double reduced_frequency = 0.0,
                double amplitude_deg = 0.0, const Comm& ranks = Comm(), const Scheme& scheme = JstScheme{})
      : comm(ranks),
        mesh(std::move(m)),
        partition(partition_mesh<2>(mesh, comm.size(), {.imbalance = 0.05, .granularity = 16})),
        local(build_local_mesh<2>(mesh, partition, comm.rank())),
        domain(comm, local, {{{0.25, 0.0}}}),
        flow(domain,
             {{1.4, mach, std::cos(angle_deg * std::numbers::pi / 180),
               std::sin(angle_deg * std::numbers::pi / 180)},
              scheme},
             time),
        kappa(2.0 * reduced_frequency * mach * std::sqrt(1.4)) {
    const double amplitude = amplitude_deg * std::numbers::pi / 180;
    motions = motions_of({.mean_pitch = 0.0, .pitch = {{0.0, -amplitude}}, .plunge = {}}, time, kappa);
  }
  MultigridCase(const MultigridCase&) = delete;
  MultigridCase& operator=(const MultigridCase&) = delete;

  DividedMesh<2> divided() const { return {mesh, partition}; }
};

struct CycledSolution {
  PseudoTimeResult result;
  std::vector<double> w;
  std::vector<double> loads;  // (force_x, force_y, moment) of every instance
};

inline std::vector<double> loads_of(MultigridCase& c, std::span<const double> w) {
  std::vector<double> values;
  for (const Loads<double>& loads : c.flow.loads(w, c.motions))
    values.insert(values.end(), {loads.force_x, loads.force_y, loads.moment});
  return values;
}

// From full multigrid's start to the tolerance.
inline CycledSolution solve_by_cycles(MultigridCase& c, const PseudoTimeOptions& options,
                                      const PseudoTimeObserver& observer = {}) {
  CycledSolution solution;
  solution.w = full_multigrid_start<2>(c.flow, c.divided(), c.motions, c.kappa, options);
  Multigrid<2> multigrid(c.flow, c.divided(), options.multigrid);
  solution.result = pseudo_time<2>(c.flow, multigrid, solution.w, c.motions, c.kappa, options, observer);
  solution.loads = loads_of(c, solution.w);
  return solution;
}

inline double relative_residual(MultigridCase& c, std::span<const double> w) {
  std::vector<double> r(c.flow.state_count());
  c.flow.residual(w, c.motions, c.kappa, r);
  return global_norm(c.comm, r) / c.flow.uniform_residual();
}

inline double largest_difference(const Comm& comm, std::span<const double> a, std::span<const double> b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return comm.max(largest);
}

}  // namespace wingbeat::testing
