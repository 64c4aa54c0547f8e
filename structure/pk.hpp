#pragma once

#include <Eigen/Dense>
#include <complex>
#include <span>
#include <string_view>
#include <vector>

#include "structure/aerodynamic_table.hpp"
#include "structure/structure_model.hpp"

namespace wingbeat {

enum class PkStatus {
  converged,
  outside_table,    // k = |Im p|/(2V) lies outside the range of Q, which was held at its end
  iteration_limit,  // no fixed point in k was found: p is the last iterate
};
std::string_view to_string(PkStatus status);

// One mode at one speed: [p^2 M + p C + K - c V^2 Q(Im p/(2V))] u_hat = 0              (eq:pk)
struct PkPoint {
  double reduced_velocity = 0.0;
  std::complex<double> p;  // motion e^{p t}, time in 1/omega_alpha
  Eigen::VectorXcd mode;   // u_hat, of unit norm
  PkStatus status = PkStatus::converged;

  double frequency() const { return std::abs(p.imag()); }
  // g = 2 Re p/|p|: twice the negative damping ratio, negative where the motion decays.
  double damping() const { return p == 0.0 ? 0.0 : 2.0 * p.real() / std::abs(p); }
  double reduced_frequency() const { return frequency() / (2.0 * reduced_velocity); }
};

// Where the growth of a mode changes sign: Re p = 0 to the tolerance, so that p-k is exact there.
struct PkCrossing {
  int branch = 0;
  PkPoint point;
  bool is_destabilising = false;  // Re p rises with V
};

struct PkResult {
  std::vector<std::vector<PkPoint>> branches;  // [mode by vacuum frequency][speed]
  std::vector<PkCrossing> crossings;           // by V ascending; inside the range of Q only
};

struct PkOptions {
  double tolerance = 1e-12;  // on k and on Re p/|p|
  int max_iterations = 60;
};

// p-k method (Hassig 1971, doi:10.2514/3.44311) at ascending speeds V > 0, the modes followed by continuity
// from V = 0 with steps in V halved until each lies much nearer to its own past than to the others.
// The first gives Q on [k_min, k_max].
PkResult pk(const StructureModel& model, const AerodynamicMatrix& q, double k_min, double k_max,
            std::span<const double> reduced_velocities, const PkOptions& options = {});
PkResult pk(const StructureModel& model, const AerodynamicTable& table,
            std::span<const double> reduced_velocities, const PkOptions& options = {});

}  // namespace wingbeat
