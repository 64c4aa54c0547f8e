#include "apps/kept_factors.hpp"

#include <algorithm>

namespace wingbeat {
namespace {

// On 128 x 32 cells 1 % in Mach number takes twice the Krylov iterations of new factors, and 3 % four times,
// which is as dear as new ones.
constexpr double most_times = 2.5;

}  // namespace

KeptFactors::Harmonics KeptFactors::lent(const FlowLevel<2>& level, int harmonics) {
  const bool is_other = std::ranges::any_of(
      factors_, [&](const auto& solver) { return solver->local_size() != level.domain.state_count(); });
  if (level.comm().any(is_other || factors_.size() != static_cast<std::size_t>(harmonics))) return {};
  is_lent_ = true;
  return factors_;
}

void KeptFactors::keep(const Harmonics& factors, int linear_iterations, int factorizations) {
  const bool are_new = !is_lent_ || factorizations > 0;
  is_lent_ = false;
  factors_ = factors;
  if (are_new)
    iterations_when_new_ = linear_iterations;
  else if (linear_iterations > most_times * iterations_when_new_)
    let_go();
}

}  // namespace wingbeat
