#include "flow/step_limit.hpp"

#include <cmath>

#include "flow/gas.hpp"

namespace wingbeat {

template <int Dim>
double largest_step(std::span<const double> w, std::span<const double> dw, double gamma, double limit) {
  constexpr int n = state_size<Dim>;
  double step = 1.0;
  for (std::size_t c = 0; c < w.size(); c += n) {
    State<Dim, Dual<double, 1>> cell;
    for (int v = 0; v < n; ++v) {
      cell[v] = w[c + static_cast<std::size_t>(v)];
      cell[v].gradient[0] = dw[c + static_cast<std::size_t>(v)];
    }
    for (const auto& quantity : {cell[0], pressure<Dim>(cell, gamma)}) {
      const double change = std::abs(quantity.gradient[0]) / quantity.value;
      if (change * step > limit) step = limit / change;
    }
  }
  return step;
}

template double largest_step<2>(std::span<const double>, std::span<const double>, double, double);
template double largest_step<3>(std::span<const double>, std::span<const double>, double, double);

}  // namespace wingbeat
