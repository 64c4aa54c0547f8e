#include "flow/steady_sequence.hpp"

#include <algorithm>

namespace wingbeat {

template <int Dim>
PseudoTransientResult solve_steady(FlowLevels<Dim>& levels, const MotionState& motion,
                                   const PseudoTransientOptions& options, const SequenceObserver& observer) {
  constexpr double coarse_tolerance = 1e-6;
  const std::size_t finest = levels.size() - 1;
  const std::size_t first = levels[finest]->w.empty() ? 0 : finest;
  PseudoTransientResult result;
  for (std::size_t l = first; l <= finest; ++l) {
    FlowLevel<Dim>& level = *levels[l];
    if (level.w.empty())
      level.w = l == 0 ? level.steady.uniform_state() : transferred_state<Dim>(*levels[l - 1], levels[l - 1]->w, level);
    PseudoTransientOptions level_options = options;
    if (l < finest) level_options.tolerance = std::max(options.tolerance, coarse_tolerance);
    result = pseudo_transient<Dim>(level.steady, motion, *level.solver, level.w, level_options,
                                   [&](const PseudoTransientIteration& i) { return !observer || observer(l, i); });
    if (result.status == SolveStatus::interrupted) break;
    // A coarse solution that went astray is no better a start than uniform flow.
    if (l < finest && result.status != SolveStatus::converged) level.w = level.steady.uniform_state();
  }
  return result;
}

template PseudoTransientResult solve_steady<2>(FlowLevels<2>&, const MotionState&, const PseudoTransientOptions&,
                                               const SequenceObserver&);
template PseudoTransientResult solve_steady<3>(FlowLevels<3>&, const MotionState&, const PseudoTransientOptions&,
                                               const SequenceObserver&);

}  // namespace wingbeat
