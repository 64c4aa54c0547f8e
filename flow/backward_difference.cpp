#include "flow/backward_difference.hpp"

#include "core/io/error.hpp"

namespace wingbeat {

BackwardDifference::BackwardDifference(int formula_order) : order(formula_order) {
  ensure(order >= 1 && order <= 3, "backward differences have order 1, 2 or 3");
  // The sum over j = 1..order of the j-th backward difference over j.
  for (int j = 1; j <= order; ++j) {
    double binomial = 1.0;  // (-1)^k (j over k)
    for (int k = 0; k <= j; ++k) {
      c[static_cast<std::size_t>(k)] += binomial / j;
      binomial *= -static_cast<double>(j - k) / (k + 1);
    }
  }
}

std::vector<double> extrapolation_weights(int levels) {
  std::vector<double> weights;
  double binomial = levels;  // (-1)^(k-1) (levels over k)
  for (int k = 1; k <= levels; ++k) {
    weights.push_back(binomial);
    binomial *= -static_cast<double>(levels - k) / (k + 1);
  }
  return weights;
}

}  // namespace wingbeat
