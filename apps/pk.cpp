#include "structure/pk.hpp"

#include "apps/case_mesh.hpp"
#include "apps/flow_setup.hpp"
#include "apps/linear_flutter_output.hpp"
#include "apps/on_root.hpp"
#include "apps/steady_stage.hpp"
#include "apps/verbs.hpp"
#include "core/io/csv.hpp"
#include "core/io/progress.hpp"

namespace wingbeat {
namespace {

// Q(k) on the finest mesh, with a line a sample.
AerodynamicTable sampled_with_progress(Context& context, LinearizedSection<2>& section) {
  const auto part = context.timer.measure("aerodynamic matrix");
  const auto [k_min, k_max] = context.settings.flutter.reduced_frequency_range;
  const std::vector<double> ks = spread_reduced_frequencies(k_min, k_max, context.settings.pk.frequencies);
  Progress progress(context.log, "aerodynamic matrix", {"k", "Qhh", "Qha", "Qah", "Qaa"});
  const auto text = [](std::complex<double> q) { return fmt::format("{:.3f}{:+.3f}i", q.real(), q.imag()); };
  std::size_t done = 0;
  return tabulate(
      [&](double k) {
        const Eigen::MatrixXcd q = section.aerodynamic_matrix(k);
        progress.row({fmt::format("{:.4f}", k), text(q(0, 0)), text(q(0, 1)), text(q(1, 0)), text(q(1, 1))},
                     static_cast<double>(++done) / static_cast<double>(ks.size()));
        return q;
      },
      ks);
}

void write_matrix(const Context& context, const AerodynamicTable& table) {
  CsvTable csv({"k", "Qhh_re", "Qhh_im", "Qha_re", "Qha_im", "Qah_re", "Qah_im", "Qaa_re", "Qaa_im"});
  for (std::size_t j = 0; j < table.samples().size(); ++j) {
    std::vector<double> row{table.sampled_k()[j]};
    for (int i = 0; i < 2; ++i)
      for (int m = 0; m < 2; ++m) {
        row.push_back(table.samples()[j](i, m).real());
        row.push_back(table.samples()[j](i, m).imag());
      }
    csv.add(row);
  }
  on_root(context.comm, [&] { csv.write(context.output / "aerodynamic_matrix.csv"); });
}

void write_branches(const Context& context, const PkResult& result, const StructureModel& model) {
  CsvTable csv({"reduced_velocity", "mode", "frequency", "damping", "growth", "reduced_frequency", "status"});
  for (std::size_t branch = 0; branch < result.branches.size(); ++branch)
    for (const PkPoint& point : result.branches[branch])
      csv.add({point.reduced_velocity, model.modes[branch], point.frequency(), point.damping(),
               point.p.real(), point.reduced_frequency(), std::string(to_string(point.status))});
  on_root(context.comm, [&] { csv.write(context.output / "pk.csv"); });
}

void report_crossings(Context& context, const PkResult& result, const StructureModel& model) {
  auto all = nlohmann::ordered_json::array();
  for (const PkCrossing& crossing : result.crossings) {
    const PkPoint& point = crossing.point;
    const std::string& mode = model.modes[static_cast<std::size_t>(crossing.branch)];
    context.log.line("p-k: the {} branch {} at V = {:.6f}, omega = {:.6f}", mode,
                     crossing.is_destabilising ? "flutters" : "recovers", point.reduced_velocity,
                     point.frequency());
    auto entry = flutter_point(context.settings, point.reduced_velocity, point.frequency());
    entry["mode"] = mode;
    entry["destabilising"] = crossing.is_destabilising;
    all.push_back(std::move(entry));
  }
  context.result.findings["pk"] = {{"crossings", std::move(all)}};
}

}  // namespace

SolveStatus run_pk(Context& context) {
  const CaseSettings& settings = context.settings;
  const StructureModel model = structure_model(typical_section(settings.structure));
  const SectionKinematics kinematics = section_kinematics(settings);
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(settings.mesh));
  FlowLevel<2>& level = *levels.back();
  History history(context);
  const SolveStatus steady = run_steady_stage(context, levels, history, true);
  if (steady != SolveStatus::converged) return steady;

  // Where the section carries lift, Q(k) is of the undeflected section: a table for all speeds.
  const AeroelasticState rest{level.w, std::vector<double>(4, 0.0), 0.0, 1.0};
  const LinearFlutterOptions options = linear_flutter_options(context);
  LinearizedSection<2> section(level, kinematics, rest, options.tolerance, options.is_stopped);
  const AerodynamicTable table = sampled_with_progress(context, section);
  write_matrix(context, table);
  const std::vector<double> velocities = settings.pk.velocities();
  const PkResult result = pk(model, table, velocities);
  write_branches(context, result, model);
  report_crossings(context, result, model);

  LinearFlutter flutter;
  flutter.roots = flutter_roots(
      model, [&](double k) { return section.aerodynamic_matrix(k); }, table);
  for (const FlutterRoot& root : flutter.roots)
    if (!flutter.root && root.is_destabilising()) flutter.root = root;
  report_linear_flutter(context, flutter);
  return SolveStatus::converged;
}

}  // namespace wingbeat
