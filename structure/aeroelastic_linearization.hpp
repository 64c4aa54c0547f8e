#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "core/algebra/linear_operator.hpp"
#include "flow/flow_equations.hpp"
#include "structure/section_kinematics.hpp"

namespace wingbeat {

// The Jacobian of the coupled problem at one state, as the flow's operators and what couples them
// to the tail t = (y^, omega, r), or t = y in static equilibrium. Tails are held on all ranks here.
//
//   [ dR/dw    G K   R_omega/s  R_r/s ]  [dw^]
//   [ S_f g          T                ]  [dt ]
//
// G: motion gradients, K: kinematics, g: load gradients, S_f = dS/df, T: the dense rest
// (eq:coupled-jacobian).
template <int Dim>
struct AeroelasticLinearization {
  const FlowEquations<Dim>* flow = nullptr;
  SectionKinematics kinematics;
  double r = 1.0;
  bool is_periodic = false;
  Eigen::MatrixXd tail;               // T
  Eigen::MatrixXd by_force;           // S_f over f = (-C_l, 2 C_m) of every instance, tail rows x 2N
  std::vector<double> flow_by_omega;  // R_omega/s and R_r/s, [instance][owned cell][variable]
  std::vector<double> flow_by_r;

  std::size_t instances() const { return flow->instance_count(); }
  std::size_t tail_size() const { return 4 * instances() + (is_periodic ? 2 : 0); }

  // yw += (G K, R_omega/s, R_r/s) t.
  void add_flow_by_tail(std::span<const double> t, std::span<double> yw) const;
  // t of the transpose: summed over ranks. Collective.
  std::vector<double> flow_by_tail_adjoint(std::span<const double> xw) const;
  // Changes of f = (-C_l, 2 C_m) of every instance that states xw cause. Collective.
  Eigen::VectorXd forces_by_flow(std::span<const double> xw) const;
  // yw += the transpose of it.
  void add_forces_by_flow_adjoint(const Eigen::VectorXd& f, std::span<double> yw) const;
};

// The tail of a distributed vector, sent from rank 0 to all. Collective.
std::vector<double> broadcast_tail(const Comm& comm, std::span<const double> x, std::size_t flow_size,
                                   std::size_t tail_size);

// The exact coupled Jacobian on vectors [w^ of the rank's cells, then, on rank 0, the tail].
template <int Dim>
class AeroelasticJacobian final : public LinearOperator<double> {
 public:
  explicit AeroelasticJacobian(const AeroelasticLinearization<Dim>& at) : at_(at) {}
  std::size_t local_size() const override;
  void apply(std::span<const double> x, std::span<double> y) const override;
  void apply_transpose(std::span<const double> x, std::span<double> y) const override;

 private:
  const AeroelasticLinearization<Dim>& at_;
};

}  // namespace wingbeat
