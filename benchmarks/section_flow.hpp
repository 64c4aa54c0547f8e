#pragma once

#include <cmath>
#include <vector>

#include "core/mesh/airfoil_families.hpp"
#include "core/mesh/conformal_omesh.hpp"
#include "flow/flow_level.hpp"

namespace wingbeat::benchmarks {

// The flow that every benchmark of a kernel computes: the O-mesh of the NACA 64A010 at Mach 0.8,
// N_H harmonics, the section in motion, a smooth disturbance of uniform flow as the state.
struct SectionFlow {
  FlowLevel<2> level;
  FlowEquations<2> equations;
  std::vector<MotionState> motions;
  double kappa = 0.3;
  std::vector<double> w;

  SectionFlow(const Comm& comm, int around, int normal, int harmonics, const Scheme& scheme = JstScheme{})
      : level(comm, mesh(around, normal), {{1.4, 0.8, 1.0, 0.0}, scheme}, {{{0.2, 0.0}}}, {}),
        equations(level.domain, level.steady.model(), TimeSpectral(harmonics)),
        w(equations.uniform_state()) {
    for (std::size_t i = 0; i < equations.instance_count(); ++i)
      motions.push_back({0.01 * std::sin(0.4 + static_cast<double>(i)), 0.002, 0.001});
    for (std::size_t i = 0; i < w.size(); ++i) w[i] *= 1.0 + 0.01 * std::sin(0.37 * static_cast<double>(i));
  }

  double cell_count() const { return static_cast<double>(level.domain.owned_count()); }
  void residual(std::span<double> r) { equations.residual(w, motions, kappa, r); }
  void linearize() { equations.linearize_state(w, motions, kappa); }

  static MultiblockMesh<2> mesh(int around, int normal) {
    OmeshOptions options;
    options.around = around;
    options.normal = normal;
    return conformal_omesh(naca_64a010(), options);
  }
};

}  // namespace wingbeat::benchmarks
