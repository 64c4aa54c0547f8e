#pragma once

#include <span>

#include "core/algebra/linear_operator.hpp"
#include "flow/flow_equations.hpp"

namespace wingbeat {

// dR/dw of the flow's last linearization, plus a value a cell on the diagonal. Both are kept by reference.
template <int Dim>
class ShiftedJacobian final : public LinearOperator<double> {
 public:
  ShiftedJacobian(const FlowEquations<Dim>& flow, std::span<const double> shift)
      : flow_(flow), shift_(shift) {}
  std::size_t local_size() const override { return flow_.state_count(); }
  void apply(std::span<const double> x, std::span<double> y) const override {
    flow_.apply(x, y);
    add_shift(x, y);
  }
  void apply_transpose(std::span<const double> x, std::span<double> y) const override {
    flow_.apply_transpose(x, y);
    add_shift(x, y);
  }

 private:
  void add_shift(std::span<const double> x, std::span<double> y) const {
    for (std::size_t i = 0; i < x.size(); ++i) y[i] += shift_[i / state_size<Dim>] * x[i];
  }
  const FlowEquations<Dim>& flow_;
  std::span<const double> shift_;
};

}  // namespace wingbeat
