#include "flow/steady_sequence.hpp"

#include <algorithm>

namespace wingbeat {

template <int Dim>
PseudoTransientResult solve_steady(FlowLevelRange<Dim> levels, const MotionState& motion,
                                   const PseudoTransientOptions& options, const SequenceObserver& observer) {
  constexpr double coarse_tolerance = 1e-6;
  const FlowLevel<Dim>* nearest = levels.back()->w.empty() ? nullptr : levels.back().get();
  PseudoTransientResult result;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    FlowLevel<Dim>& level = *levels[l];
    const bool is_finest = l + 1 == levels.size();
    if (level.w.empty())
      level.w = nearest ? transferred_state<Dim>(*nearest, nearest->w, level) : level.steady.uniform_state();
    PseudoTransientOptions level_options = options;
    if (!is_finest) level_options.tolerance = std::max(options.tolerance, coarse_tolerance);
    result =
        pseudo_transient<Dim>(level.steady, motion, *level.solver, level.w, level_options,
                              [&](const PseudoTransientIteration& i) { return !observer || observer(l, i); });
    if (result.status == SolveStatus::interrupted) break;
    if (result.status == SolveStatus::converged)
      nearest = &level;
    else if (!is_finest)
      level.w.clear();
  }
  return result;
}

template PseudoTransientResult solve_steady<2>(FlowLevelRange<2>, const MotionState&,
                                               const PseudoTransientOptions&, const SequenceObserver&);
template PseudoTransientResult solve_steady<3>(FlowLevelRange<3>, const MotionState&,
                                               const PseudoTransientOptions&, const SequenceObserver&);

}  // namespace wingbeat
