#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/algebra/dense_matrix.hpp"
#include "core/algebra/gmres.hpp"
#include "flow/flow_level.hpp"
#include "flow/frequency_operator.hpp"

namespace wingbeat {

// The loads of small rigid motion over a range of frequencies from the factors of a few of them: the linear
// equations of the flow are projected on its response there and on the derivatives of that with respect to
// frequency, which the projection then reproduces (eq:reduced-response; Grimme 1997,
// https://hdl.handle.net/2142/81180).
template <int Dim>
class ReducedResponse {
 public:
  // `level`: its steady flow linearized at rest, kept alive and linearized there. `kappas`, on the flow's
  // clock, are where it is factored. `gmres` gives lengths and tolerance of the linear solves. Collective.
  ReducedResponse(const FlowLevel<Dim>& level, std::span<const double> kappas, const GmresOptions& gmres);

  // Takes the response itself, and with every further call one more derivative, into the projection: three
  // linear solves a frequency. Collective. Throws SolveFailure where one of them fails.
  void extend();

  // The same on every rank.
  LoadResponse at(double kappa) const;

 private:
  using Complex = std::complex<double>;
  using Field = std::vector<Complex>;

  struct Expansion {
    double kappa;
    std::unique_ptr<SchwarzSolver<Complex>> solver;
    std::vector<Field> sides;  // of the next linear solves
  };

  void add_to_basis(std::vector<double> v);
  void project();

  const FlowEquations<Dim>& flow_;
  GmresOptions gmres_;
  std::vector<Expansion> expansions_;
  DenseMatrix<double> basis_;      // orthonormal, a column each
  DenseMatrix<double> images_;     // of the basis by dR/dw
  DenseMatrix<double> stiffness_;  // projections of dR/dw,
  DenseMatrix<double> mass_;       // of the volumes,
  DenseMatrix<double> inputs_;     // of dR/d(pitch, pitch_rate, plunge_rate), a column each,
  DenseMatrix<double> outputs_;    // and of the gradients of (force_y, moment), a row each
};

}  // namespace wingbeat
