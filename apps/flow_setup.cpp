#include "apps/flow_setup.hpp"

#include <cmath>
#include <numbers>

#include "adjoint/load_functional.hpp"
#include "apps/case_mesh.hpp"
#include "apps/memory_check.hpp"
#include "core/io/counted.hpp"

namespace wingbeat {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

Scheme flow_scheme(const FlowSettings& settings) {
  const Limiter limiter =
      settings.limiter == "venkatakrishnan" ? Limiter::venkatakrishnan : Limiter::van_albada;
  if (settings.scheme == "matrix")
    return MatrixScheme{settings.matrix_k2, settings.matrix_k4, settings.jst_smoothing,
                        settings.matrix_acoustic_floor, settings.matrix_linear_floor};
  if (settings.scheme == "cusp") return CuspScheme{};
  if (settings.scheme == "roe") return RoeScheme{limiter, settings.entropy_fix};
  if (settings.scheme == "van_leer") return VanLeerScheme{limiter};
  return JstScheme{settings.jst_k2, settings.jst_k4, settings.jst_smoothing};
}

}  // namespace

bool has_structure(const CaseSettings& settings) { return settings.structure.mass_ratio > 0.0; }

template <int Dim>
FlowModel<Dim, double> flow_model(const FlowSettings& settings) {
  const double angle = radians(settings.angle_of_attack_deg);
  return {{settings.gamma, settings.mach, std::cos(angle), std::sin(angle)}, flow_scheme(settings)};
}

TypicalSection typical_section(const StructureSettings& settings) {
  TypicalSection section;
  section.elastic_axis = settings.elastic_axis;
  section.static_unbalance = settings.static_unbalance;
  section.gyration_radius_squared = settings.gyration_radius_squared;
  section.frequency_ratio = settings.frequency_ratio;
  section.mass_ratio = settings.mass_ratio;
  section.damping = settings.damping;
  section.plunge_spring = {settings.plunge_cubic, settings.plunge_quintic, settings.plunge_freeplay};
  section.pitch_spring = {settings.pitch_cubic, settings.pitch_quintic, radians(settings.pitch_freeplay_deg)};
  section.freeplay_smoothing = settings.freeplay_smoothing;
  return section;
}

SectionKinematics section_kinematics(const CaseSettings& settings) {
  SectionKinematics kinematics;
  kinematics.flow_speed = settings.flow.mach * std::sqrt(settings.flow.gamma);
  kinematics.mean_pitch = radians(settings.pitch.mean_deg);
  return kinematics;
}

Vec<double, 2> rotation_axis(const CaseSettings& settings) {
  if (has_structure(settings)) return {{{elastic_axis_in_chords(typical_section(settings.structure)), 0.0}}};
  return {{{settings.pitch.axis[0], settings.pitch.axis[1]}}};
}

PartitionOptions partition_options(const CaseSettings& settings) {
  return {.imbalance = settings.partition.imbalance,
          .granularity = settings.solver.uses_cycles() ? settings.pseudo_time.granularity() : 1};
}

template <int Dim>
FlowLevels<Dim> make_levels(Context& context, const MultiblockMesh<Dim>& mesh) {
  const auto part = context.timer.measure("mesh");
  const CaseSettings& settings = context.settings;
  const FlowLevelOptions options{partition_options(settings), subdomain_options(settings.solver)};
  const auto statistics =
      partition_statistics<Dim>(mesh, partition_mesh<Dim>(mesh, context.comm.size(), options.partition),
                                2 * settings.time.harmonics + 1);
  check_memory(context, mesh.cell_count(), statistics);
  FlowLevels<Dim> levels;
  auto meshes = mesh_sequence(settings.mesh, mesh, settings.solver.coarse_levels);
  for (auto& level_mesh : meshes) {
    const bool is_finest = &level_mesh == &meshes.back();
    if (!is_finest && level_mesh.cell_count() < static_cast<std::size_t>(context.comm.size())) continue;
    levels.push_back(std::make_unique<FlowLevel<Dim>>(context.comm, std::move(level_mesh),
                                                      flow_model<Dim>(settings.flow), rotation_axis(settings),
                                                      options));
  }
  std::string sizes;
  for (const auto& level : levels) sizes += (sizes.empty() ? "" : ", ") + mesh_size_text<Dim>(level->mesh);
  context.log.line("meshes {}; every BCWall of the mesh is a slip wall", sizes);
  context.log.line("{}: {}, imbalance {:.1f} %, {} faces cut, {} halo cells",
                   counted(statistics.ranks, "rank"), counted(statistics.blocks, "block"),
                   100.0 * statistics.imbalance, statistics.edge_cut, statistics.halo_cells);
  return levels;
}

SubdomainOptions subdomain_options(const SolverSettings& settings) {
  // Layers of the matrix, which reaches two cells to each side.
  return {.overlap = (settings.overlap + 1) / 2,
          .method = settings.subdomain == "ilu" ? SubdomainMethod::ilu : SubdomainMethod::lu,
          .fill = settings.ilu_fill};
}

GmresOptions gmres_options(const SolverSettings& settings) {
  GmresOptions options;
  options.restart = settings.krylov_restart;
  options.max_iterations = settings.max_linear_iterations;
  options.deflation = settings.krylov_deflation;
  return options;
}

PseudoTransientOptions steady_options(const SolverSettings& settings) {
  PseudoTransientOptions options;
  options.tolerance = settings.steady_target();
  options.max_iterations = settings.max_steady_iterations;
  options.gmres = gmres_options(settings);
  return options;
}

ForcedFlowOptions forced_flow_options(const SolverSettings& settings) {
  ForcedFlowOptions options{.tolerance = settings.flow_tolerance, .newton = {}};
  options.newton.max_iterations = settings.max_newton_iterations;
  options.newton.gmres = gmres_options(settings);
  return options;
}

Coefficients coefficients(const CaseSettings& settings, const Loads<double>& loads, double pitch) {
  const double angle = radians(settings.flow.angle_of_attack_deg);
  Vec<double, 2> arm{};
  if (const auto& reference = settings.flow.moment_reference)
    arm = rigid_motion({pitch, 0.0, 0.0})
              .turned(Vec<double, 2>{{{(*reference)[0], (*reference)[1]}}} - rotation_axis(settings));
  const auto value = [&](LoadCoefficient which) {
    const Loads<double> weights = coefficient_weights(which, angle, arm);
    return load_dot({&weights, 1}, {&loads, 1});
  };
  return {value(LoadCoefficient::lift), value(LoadCoefficient::drag), value(LoadCoefficient::moment)};
}

template FlowModel<2, double> flow_model<2>(const FlowSettings&);
template FlowModel<3, double> flow_model<3>(const FlowSettings&);
template FlowLevels<2> make_levels<2>(Context&, const MultiblockMesh<2>&);
template FlowLevels<3> make_levels<3>(Context&, const MultiblockMesh<3>&);

}  // namespace wingbeat
