#pragma once

#include <Eigen/Dense>
#include <complex>
#include <vector>

#include "flow/harmonic_preconditioner.hpp"
#include "structure/aeroelastic_linearization.hpp"

namespace wingbeat {

// Approximate inverse of the coupled Jacobian [A B; C T]: A by a preconditioner P of the flow, the
// tail by the dense Schur complement T - C X, X = P^-1 B (eq:bordered-preconditioner). X is built
// from one response a harmonic to the motion gradients averaged over the instances, and is kept
// until rebuilt.
template <int Dim>
class BorderedPreconditioner final : public LinearOperator<double> {
 public:
  // `flow_preconditioner`: P in apply; the harmonic one gives the responses.
  BorderedPreconditioner(const AeroelasticLinearization<Dim>& at,
                         const HarmonicPreconditioner<Dim>& harmonic);

  // Uses another approximate inverse of dR/dw in place of the harmonic one.
  void use(const LinearOperator<double>& flow_preconditioner) { flow_preconditioner_ = &flow_preconditioner; }
  // Computes X with the current factors. Collective.
  void build_responses();
  bool has_responses() const { return !responses_.empty(); }
  // Renews T - C X with the current linearization. Collective.
  void update_schur();

  std::size_t local_size() const override;
  void apply(std::span<const double> x, std::span<double> y) const override;
  void apply_transpose(std::span<const double> x, std::span<double> y) const override;

 private:
  using Complex = std::complex<double>;
  const TimeSpectral& time() const { return at_.flow->time(); }
  std::span<const Complex> response(int h, int k) const {
    return responses_[static_cast<std::size_t>(3 * h + k)];
  }
  void subtract_x(std::span<const double> t, std::span<double> yw) const;  // yw -= X t
  std::vector<double> x_adjoint(std::span<const double> xw) const;         // X^T xw, collective
  Eigen::MatrixXd forces_by_tail() const;                                  // g X, 2N x tail, collective

  const AeroelasticLinearization<Dim>& at_;
  const HarmonicPreconditioner<Dim>& harmonic_;
  const LinearOperator<double>* flow_preconditioner_;
  std::vector<std::vector<Complex>> responses_;  // [3 h + k]: of harmonic h to motion component k
  std::vector<double> by_omega_, by_r_;          // P^-1 of R_omega/s and R_r/s
  Eigen::PartialPivLU<Eigen::MatrixXd> schur_;
};

}  // namespace wingbeat
