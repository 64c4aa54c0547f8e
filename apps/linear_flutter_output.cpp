#include "apps/linear_flutter_output.hpp"

#include "apps/flow_setup.hpp"

namespace wingbeat {

LinearFlutterOptions linear_flutter_options(const Context& context) {
  const CaseSettings& settings = context.settings;
  LinearFlutterOptions options;
  options.reduced_frequency_range = settings.flutter.reduced_frequency_range;
  options.samples = settings.flutter.samples;
  options.newton.max_iterations = settings.solver.max_newton_iterations;
  options.newton.gmres = gmres_options(settings.solver);
  options.tolerances = {settings.solver.flow_tolerance, settings.solver.structure_tolerance};
  options.is_stopped = [&stop = context.stop] { return stop.is_set(); };
  return options;
}

nlohmann::ordered_json flutter_point(const CaseSettings& settings, double reduced_velocity, double omega) {
  nlohmann::ordered_json point{{"reduced_velocity", reduced_velocity}};
  if (settings.structure.mass_ratio > 0.0)
    point["speed_index"] = speed_index(typical_section(settings.structure), reduced_velocity);
  point["frequency_ratio"] = omega;
  point["reduced_frequency"] = omega / (2.0 * reduced_velocity);
  return point;
}

void report_linear_flutter(Context& context, const LinearFlutter& flutter) {
  context.log.line("\nroots of the linearized problem");
  context.log.line("{:>12} {:>12} {:>12}  rising speed", "V", "omega", "k");
  auto all = nlohmann::ordered_json::array();
  for (const FlutterRoot& root : flutter.roots) {
    context.log.line("{:12.6f} {:12.6f} {:12.6f}  {}", root.reduced_velocity, root.frequency,
                     root.reduced_frequency, root.is_destabilising() ? "destabilises" : "stabilises");
    auto entry = flutter_point(context.settings, root.reduced_velocity, root.frequency);
    entry["destabilising"] = root.is_destabilising();
    all.push_back(std::move(entry));
  }
  if (flutter.root)
    context.result.findings["linear_flutter"] =
        flutter_point(context.settings, flutter.root->reduced_velocity, flutter.root->frequency);
  context.result.findings["linear_flutter_roots"] = std::move(all);
}

std::string no_flutter_message(const CaseSettings& settings) {
  const auto& [k_min, k_max] = settings.flutter.reduced_frequency_range;
  return fmt::format(
      "no flutter root with reduced frequency between {} and {}; widen flutter.reduced_frequency_range, or "
      "the section "
      "does not flutter at this Mach number",
      k_min, k_max);
}

}  // namespace wingbeat
