#pragma once

#include <vector>

#include "adjoint/parameters.hpp"
#include "core/algebra/newton.hpp"

namespace wingbeat {

// How rows and objective change with the inputs at a given state.
struct InputTangent {
  std::vector<double> rows;  // dF, in the layout of the problem
  double objective = 0.0;    // dJ
};

// A number J(u; p) of a solved problem F(u; p) = 0, with all that a tangent or an adjoint asks of both.
// The problem must be linearized at its solution. All calls are collective.
template <int Dim>
class Functional {
 public:
  virtual ~Functional() = default;
  virtual const Comm& comm() const = 0;
  virtual const Problem& problem() const = 0;
  virtual FlowPoint point() const = 0;
  virtual double value() const = 0;
  // dJ/du, in the layout of the problem.
  virtual std::vector<double> by_state() const = 0;
  virtual InputTangent tangent(const Inputs<Dim>& change) const = 0;
  // dJ/dp + multipliers^T dF/dp: the transpose of it.
  virtual Inputs<Dim> sensitivity(std::span<const double> multipliers) const = 0;
};

}  // namespace wingbeat
