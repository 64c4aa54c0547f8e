#include "apps/pk_output.hpp"

#include "apps/linear_flutter_output.hpp"
#include "apps/on_root.hpp"
#include "core/io/csv.hpp"
#include "structure/flutter_roots.hpp"

namespace wingbeat {

void write_modes(const Context& context, const PkResult& result, const StructureModel& model,
                 const std::string& file) {
  CsvTable csv({"reduced_velocity", "mode", "frequency", "damping", "growth", "reduced_frequency", "status"});
  for (std::size_t branch = 0; branch < result.branches.size(); ++branch)
    for (const PkPoint& point : result.branches[branch])
      csv.add({point.reduced_velocity, model.modes[branch], point.frequency(), point.damping(),
               point.p.real(), point.reduced_frequency(), std::string(to_string(point.status))});
  on_root(context.comm, [&] { csv.write(context.output / file); });
}

void report_crossings(Context& context, const PkResult& result, const StructureModel& model,
                      const std::string& method, const std::string& key) {
  auto all = nlohmann::ordered_json::array();
  for (const PkCrossing& crossing : result.crossings) {
    const PkPoint& point = crossing.point;
    const std::string& mode = model.modes[static_cast<std::size_t>(crossing.branch)];
    context.log.line("{}: the {} branch {} at V = {:.6f}, omega = {:.6f}", method, mode,
                     crossing.is_destabilising ? "flutters" : "recovers", point.reduced_velocity,
                     point.frequency());
    auto entry = flutter_point(context.settings, point.reduced_velocity, point.frequency());
    entry["mode"] = mode;
    entry["destabilising"] = crossing.is_destabilising;
    all.push_back(std::move(entry));
  }
  context.result.findings[key] = {{"crossings", std::move(all)}};
}

void report_divergence(Context& context, const StructureModel& model, const Eigen::MatrixXd& steady_matrix) {
  const std::vector<double> speeds = divergence_speeds(model, steady_matrix);
  if (speeds.empty()) {
    context.log.line("divergence: none at any speed");
    context.result.findings["divergence"] = nullptr;
    return;
  }
  context.log.line("divergence: at V = {:.6f}", speeds.front());
  auto entry = flutter_point(context.settings, speeds.front(), 0.0);
  entry.erase("frequency_ratio");
  entry.erase("reduced_frequency");
  context.result.findings["divergence"] = std::move(entry);
}

}  // namespace wingbeat
