#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "core/algebra/schwarz.hpp"
#include "flow/flow_equations.hpp"

namespace wingbeat {

// The factors of one harmonic each of mean Jacobian + i h kappa Omega: real for h = 0.
struct HarmonicFactors {
  std::shared_ptr<SchwarzSolver<double>> mean;
  std::vector<std::shared_ptr<SchwarzSolver<std::complex<double>>>> harmonics;  // h = 1..N_H
};

// Approximate inverse of dR/dw = blkdiag(J_n) + kappa D x Omega: the Jacobians are replaced by
// their mean over the instances, whereupon the harmonics decouple (eq:harmonic-preconditioner):
//   (mean J + i h kappa Omega) x_h = b_h,  h = 0..N_H.
// Exact where the instances are alike; on several ranks each solve is a Schwarz sweep.
template <int Dim>
class HarmonicPreconditioner final : public LinearOperator<double> {
 public:
  using Complex = std::complex<double>;

  // Takes factors that exist already (those of the steady and the linearized problem, say).
  HarmonicPreconditioner(const FlowDomain<Dim>& domain, const TimeSpectral& time, HarmonicFactors factors);

  // Factors the mean of the flow's Jacobians at the given frequency: of all harmonics, or only of
  // those that have no factors yet. Collective.
  void factor(const FlowEquations<Dim>& flow, double kappa);
  void factor_missing(const FlowEquations<Dim>& flow, double kappa);
  bool is_factored() const;

  std::size_t local_size() const override {
    return static_cast<std::size_t>(time_.instances()) * domain_.state_count();
  }
  void apply(std::span<const double> x, std::span<double> y) const override;
  void apply_transpose(std::span<const double> x, std::span<double> y) const override;

  // Response of one harmonic to a real right-hand side of one instance's size.
  std::vector<Complex> solve_harmonic(int h, std::span<const double> rhs) const;

 private:
  void factor(const FlowEquations<Dim>& flow, double kappa, bool keep_existing);
  void solve(std::span<const double> x, std::span<double> y, bool transposed) const;

  const FlowDomain<Dim>& domain_;
  TimeSpectral time_;
  HarmonicFactors factors_;
};

// Harmonic preconditioner, then one exact solve an instance with the coupling of instances left
// out, multiplicatively: worth its cost where a shock moves across cells within the period
// (eq:multiplicative-preconditioner).
template <int Dim>
class MultiplicativePreconditioner final : public LinearOperator<double> {
 public:
  MultiplicativePreconditioner(const FlowEquations<Dim>& flow, const HarmonicPreconditioner<Dim>& harmonic,
                               std::shared_ptr<const Subdomain> subdomain);

  // Factors every instance's Jacobian. Collective.
  void factor();

  std::size_t local_size() const override { return harmonic_.local_size(); }
  void apply(std::span<const double> x, std::span<double> y) const override;
  void apply_transpose(std::span<const double> x, std::span<double> y) const override;

 private:
  void solve_instances(std::span<const double> x, std::span<double> y, bool transposed) const;

  const FlowEquations<Dim>& flow_;
  const HarmonicPreconditioner<Dim>& harmonic_;
  std::vector<std::unique_ptr<SchwarzSolver<double>>> instances_;
};

// Factors for N_H harmonics, not yet computed.
HarmonicFactors unfactored(const Comm& comm, const std::shared_ptr<const Subdomain>& subdomain,
                           int block_size, int harmonics);

// Memory of factors on this rank.
double factor_bytes(const HarmonicFactors& factors);

// kappa Omega i h as the diagonal shift of a factorization.
std::vector<std::complex<double>> harmonic_shift(std::span<const double> volumes, double frequency);

}  // namespace wingbeat
