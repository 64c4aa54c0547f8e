#pragma once

#include <Eigen/Dense>
#include <complex>
#include <limits>
#include <vector>

#include "structure/aerodynamic_table.hpp"
#include "structure/structure_model.hpp"

namespace wingbeat {

// A harmonic solution u_hat e^{i omega t} with real omega and V > 0 of                 (eq:flutter)
//   [-omega^2 M + i omega C + K - c V^2 Q(k)] u_hat = 0,   k = omega/(2 V).
struct FlutterRoot {
  double reduced_velocity = 0.0;   // V
  double frequency = 0.0;          // omega, in omega_alpha
  double reduced_frequency = 0.0;  // k
  Eigen::VectorXcd mode;           // u_hat, of unit norm
  double growth_slope = 0.0;       // d(Re p)/dV, motion as e^{p t}: > 0 where rising speed destabilises
  // |Im V|/|V| of the eigenvalue V(k); after a polish, what its convergence leaves to be expected.
  double residual = 0.0;
  int evaluations = 0;        // of the exact Q, by the polish
  bool is_converged = false;  // residual <= tolerance with the Q it was asked for

  bool is_destabilising() const { return growth_slope > 0.0; }
};

struct FlutterOptions {
  double velocity_max = std::numeric_limits<double>::infinity();
  int scan_steps = 200;      // largest step in k: the range over this; steps shrink where needed
  double tolerance = 1e-10;  // on |Im V|/|V|
  int max_evaluations = 8;   // of the exact Q, a root
};

// Every root with k in the range of the table, by V ascending: the first destabilising one is the
// flutter point. For fixed k the equation is a quadratic eigenvalue problem in 1/V (eq:velocity-eigenvalue);
// its branches are followed from k to k by continuity (exact slopes, steps halved until the match is clear)
// and a root is where 1/V crosses the positive real axis. Throws InputError unless K is positive definite.
std::vector<FlutterRoot> scan_flutter_roots(const StructureModel& model, const AerodynamicTable& table,
                                            const FlutterOptions& options = {});

// Moves a root found with `table` to where it is with `exact` (a finer mesh, say): the difference exact -
// table is interpolated through every point evaluated. Three evaluations do from a start 1 % off; it stops
// where the next residual, extrapolated from the last two, is within the tolerance.
FlutterRoot polish_flutter_root(const StructureModel& model, const AerodynamicMatrix& exact,
                                const AerodynamicTable& table, const FlutterRoot& start,
                                const FlutterOptions& options = {});

// Scan, then polish of every root.
std::vector<FlutterRoot> flutter_roots(const StructureModel& model, const AerodynamicMatrix& exact,
                                       const AerodynamicTable& table, const FlutterOptions& options = {});

// Speeds of static divergence, det[K - c V^2 Q(0)] = 0, ascending; empty where there are none.
std::vector<double> divergence_speeds(const StructureModel& model, const Eigen::MatrixXd& steady_matrix);

}  // namespace wingbeat
