#include "structure/pk.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

#include "apps/case_mesh.hpp"
#include "apps/flow_setup.hpp"
#include "apps/linear_flutter_output.hpp"
#include "apps/pk_aerodynamics.hpp"
#include "apps/pk_output.hpp"
#include "apps/restart.hpp"
#include "apps/steady_stage.hpp"
#include "apps/verbs.hpp"
#include "core/io/error.hpp"
#include "structure/forced_matrix.hpp"
#include "structure/g_method.hpp"

namespace wingbeat {
namespace {

constexpr const char* matrix_file = "aerodynamic_matrix.csv";
constexpr const char* forced_matrix_file = "aerodynamic_matrix_forced.csv";

StructureModel structure_of(const CaseSettings& settings) {
  if (settings.modal.is_given()) return structure_model(settings.modal);
  return structure_model(typical_section(settings.structure));
}

bool is_positive_definite(const Eigen::MatrixXd& matrix) {
  return Eigen::LLT<Eigen::MatrixXd>(matrix).info() == Eigen::Success;
}

// Modes against speed by both methods, and the roots and divergence where K admits them. `exact` gives Q
// where the table has no sample; without it the table is all there is.
void report(Context& context, const StructureModel& model, const AerodynamicTable& table,
            const AerodynamicMatrix& exact, const std::optional<Eigen::MatrixXd>& steady_matrix) {
  print_sizes_and_phases(context, table);
  const std::vector<double> velocities = context.settings.pk.velocities();
  context.log.line("");
  if (!model.restoring.empty())
    context.log.line("the nonlinear part of the springs is left out: what follows is linear");
  const PkResult by_pk = pk(model, table, velocities);
  write_modes(context, by_pk, model, "pk.csv");
  report_crossings(context, by_pk, model, "p-k", "pk");
  const PkResult by_g = g_method(model, table, velocities);
  write_modes(context, by_g, model, "g_method.csv");
  report_crossings(context, by_g, model, "g method", "g_method");
  if (!is_positive_definite(model.stiffness)) {
    context.log.line("K is singular: neither roots nor divergence are sought");
    return;
  }
  if (steady_matrix) {
    report_divergence(context, model, *steady_matrix);
  } else {
    context.log.line("divergence: not known, the table has no row k = 0");
  }
  LinearFlutter flutter;
  flutter.roots = exact ? flutter_roots(model, exact, table) : scan_flutter_roots(model, table);
  for (const FlutterRoot& root : flutter.roots)
    if (!flutter.root && root.is_destabilising()) flutter.root = root;
  report_linear_flutter(context, flutter);
}

void report_from_table(Context& context, const StructureModel& model) {
  const AerodynamicTable table = read_aerodynamics(context, model.size());
  write_aerodynamics(context, table, matrix_file);
  std::optional<Eigen::MatrixXd> steady;
  if (table.k_min() == 0.0) steady = table(0.0).real();
  report(context, model, table, {}, steady);
}

// Samples Q, adds what the crossings need and reports.
void report_from_flow(Context& context, const StructureModel& model, const std::string& title,
                      const AerodynamicMatrix& q, const std::string& file, const Eigen::MatrixXd& steady) {
  AerodynamicTable table = sample_aerodynamics(context, title, q);
  write_aerodynamics(context, table, file);
  table = refined_at_crossings(model, std::move(table), q, context.settings.pk.velocities());
  write_aerodynamics(context, table, file);
  report(context, model, table, q, steady);
}

// Q(k) by small forced motions. With a single harmonic the second, of the square of the amplitude, would
// be taken for the first.
AerodynamicMatrix forced_aerodynamics(Context& context, FlowLevel<2>& level) {
  const CaseSettings& settings = context.settings;
  ForcedMatrixOptions options;
  options.amplitude = settings.pitch.derivative_amplitude_deg * std::numbers::pi / 180.0;
  options.flow = forced_flow_options(settings.solver);
  options.observer = [&context](const ForcedFlowIteration&) { return !context.stop.is_set(); };
  return [&level, options, kinematics = section_kinematics(settings),
          time = TimeSpectral(std::max(2, settings.time.harmonics))](double k) -> Eigen::MatrixXcd {
    return forced_aerodynamic_matrix<2>(level, time, kinematics, k, options);
  };
}

}  // namespace

std::vector<std::string> pk_sections(const CaseSettings& settings) {
  std::vector<std::string> sections{"flutter", "pk"};
  const bool reads_table = settings.pk.reads_table();
  sections.push_back(reads_table && settings.modal.is_given() ? "modal" : "structure");
  if (!reads_table) sections.insert(sections.end(), {"mesh", "partition", "flow", "pitch", "solver"});
  if (settings.pk.aerodynamics == "forced") sections.push_back("time");
  return sections;
}

std::vector<std::string> pk_faults(const CaseSettings& settings) {
  if (!settings.modal.is_given()) return {};
  if (!settings.pk.reads_table())
    return {
        "modal.modes: a structure by its matrices needs pk.aerodynamics = \"table\"; for Q(k) of a flow give "
        "[structure]"};
  if (settings.structure.mass_ratio > 0.0)
    return {"modal.modes: the case has a [structure], too; leave one of them out"};
  try {
    structure_model(settings.modal);
  } catch (const InputError& error) {
    return {fmt::format("modal: {}", error.what())};
  }
  return {};
}

SolveStatus run_pk(Context& context) {
  const CaseSettings& settings = context.settings;
  const StructureModel model = structure_of(settings);
  if (settings.pk.reads_table()) {
    report_from_table(context, model);
    return SolveStatus::converged;
  }
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(context.comm, settings.mesh));
  FlowLevel<2>& level = *levels.back();
  if (context.restart) level.w = read_restart(context, level, {1}).w;
  History history(context);
  const SolveStatus steady = run_steady_stage(context, levels, history, true);
  if (steady != SolveStatus::converged) return steady;

  // Where the section carries lift, Q(k) is of the undeflected section: a table for all speeds.
  const AeroelasticState rest{level.w, std::vector<double>(4, 0.0), 0.0, 1.0};
  const LinearFlutterOptions options = linear_flutter_options(context);
  LinearizedSection<2> section(level, section_kinematics(settings), rest, options.tolerance,
                               options.is_stopped, options.newton.gmres);
  const AerodynamicMatrix linearized = [&section](double k) { return section.aerodynamic_matrix(k); };
  const Eigen::MatrixXd steady_matrix = linearized(0.0).real();
  if (settings.pk.aerodynamics == "linearized") {
    report_from_flow(context, model, "aerodynamic matrix", linearized, matrix_file, steady_matrix);
    return SolveStatus::converged;
  }
  write_aerodynamics(context, sample_aerodynamics(context, "aerodynamic matrix", linearized), matrix_file);
  report_from_flow(context, model, "aerodynamic matrix by forced motions",
                   forced_aerodynamics(context, level), forced_matrix_file, steady_matrix);
  return SolveStatus::converged;
}

}  // namespace wingbeat
