#include "apps/flutter_starts.hpp"

#include <algorithm>
#include <limits>

#include "apps/flow_setup.hpp"
#include "apps/linear_flutter_output.hpp"
#include "apps/neighbour.hpp"

namespace wingbeat {
namespace {

std::vector<const FlutterRoot*> wanted_roots(const CaseSettings& settings, const LinearFlutter& flutter) {
  std::vector<const FlutterRoot*> wanted;
  for (const FlutterRoot& root : flutter.roots)
    if (root.is_destabilising() && (wanted.empty() || settings.flutter.wants_all_roots()))
      wanted.push_back(&root);
  return wanted;
}

LinearFlutterSolution<2> linear_flutter(Context& context, FlowLevelRange<2> levels,
                                        const StructureModel& model, const LinearFlutterOptions& options) {
  const auto part = context.timer.measure("linear flutter");
  auto linear = solve_linear_flutter<2>(levels, model, section_kinematics(context.settings), options);
  report_linear_flutter(context, linear.flutter);
  return linear;
}

// To see which roots there are, no more.
LinearFlutterOptions sketched(LinearFlutterOptions options) {
  options.sketch_accuracy = 0.03;
  options.tolerance = 1e-4;
  options.settled_speed = 1e-2;
  options.polish_margin = 0.0;
  return options;
}

}  // namespace

std::vector<CycleStart> flutter_starts(Context& context, FlowLevels<2>& levels, const StructureModel& model,
                                       CycleSolver& solver, double energy) {
  const CaseSettings& settings = context.settings;
  LinearFlutterOptions options = linear_flutter_options(context);
  if (settings.flutter.wants_all_roots()) options.polish_margin = std::numeric_limits<double>::infinity();
  // By turns, the roots of the next coarser mesh are near enough to start from.
  const FlowLevelRange<2> all(levels);
  const FlowLevelRange<2> linearized =
      settings.solver.is_staggered() && levels.size() > 1 ? all.first(levels.size() - 1) : all;
  LinearFlutterSolution<2> linear = linear_flutter(context, linearized, model, options);
  const auto wanted = wanted_roots(settings, linear.flutter);
  std::vector<CycleStart> starts;
  // The lowest last: the factors that the starts share are then its own.
  for (auto root = wanted.rbegin(); root != wanted.rend(); ++root)
    starts.push_back(solver.linear_start(linear, **root, *linearized.back(), energy));
  std::ranges::reverse(starts);
  if (starts.empty()) context.result.message = no_flutter_message(settings);
  return starts;
}

std::vector<CycleStart> neighbouring_starts(Context& context, FlowLevels<2>& levels,
                                            const StructureModel& model, CycleSolver& solver, double energy,
                                            const std::vector<AeroelasticState>& neighbours) {
  const CaseSettings& settings = context.settings;
  const FlowLevelRange<2> coarsest = FlowLevelRange<2>(levels).first(1);
  const auto linear = linear_flutter(context, coarsest, model, sketched(linear_flutter_options(context)));
  std::vector<CycleStart> starts;
  for (const FlutterRoot* root : wanted_roots(settings, linear.flutter)) {
    const AeroelasticState* cycle = cycle_near(settings, root->reduced_velocity, root->frequency, neighbours);
    if (!cycle) return {};
    starts.push_back(solver.moved(*cycle, energy));
  }
  if (!starts.empty()) solver.lend_factors(starts.front());
  return starts;
}

}  // namespace wingbeat
