#include "apps/optimum.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "apps/flow_setup.hpp"
#include "apps/on_root.hpp"
#include "apps/sub_run.hpp"
#include "core/io/file.hpp"
#include "core/mesh/cgns_mesh.hpp"
#include "optimize/ordinates.hpp"

namespace wingbeat {
namespace {

// A deformed section, ready to be analysed: ordinates, mesh and case.
struct SectionFolder {
  std::filesystem::path folder;
  CaseSettings settings;
};

SectionFolder write_section(Context& context, const std::string& name, const MultiblockMesh<2>& mesh,
                            const ShapeVariables& shape, std::span<const double> amplitudes,
                            double angle_change) {
  SectionFolder section{context.output / name, context.settings};
  CaseSettings by_ordinates = context.settings;
  by_ordinates.flow.angle_of_attack_deg += angle_change;
  by_ordinates.mesh.airfoil = "airfoil.dat";
  by_ordinates.mesh.file.reset();
  CaseSettings& by_mesh = section.settings;
  by_mesh = by_ordinates;
  by_mesh.mesh.airfoil.reset();
  by_mesh.mesh.file = "mesh.cgns";
  const MultiblockMesh<2> deformed = shape.deformed_mesh(context.comm, mesh, amplitudes);
  on_root(context.comm, [&] {
    std::filesystem::create_directories(section.folder);
    write_cgns(deformed, section.folder / "mesh.cgns");
    const auto change = shape.bumps().displacement(amplitudes);
    std::vector<Vec<double, 2>> wall = shape.wall().positions;
    for (std::size_t i = 0; i < wall.size(); ++i) wall[i] += change[i];
    write_ordinates(section.folder / "airfoil.dat", name, wall);
    write_file(section.folder / "case.toml",
               "# The section on the mesh it was optimised on.\n\n" + case_text(by_mesh, context.sources));
    if (context.settings.mesh.airfoil)
      write_file(section.folder / "airfoil.toml",
                 "# The section by its ordinates: choose mesh.cells for a mesh of its own.\n\n" +
                     case_text(by_ordinates, context.sources));
  });
  by_mesh.mesh.file = std::filesystem::absolute(section.folder / "mesh.cgns").lexically_normal().string();
  return section;
}

}  // namespace

SolveStatus finish_optimization(Context& context, const MultiblockMesh<2>& mesh, const ShapeVariables& shape,
                                const DesignVariables& variables, OptimizationOutcome outcome) {
  const Comm& comm = context.comm;
  double status = static_cast<double>(static_cast<int>(outcome.status));
  comm.broadcast(status);
  outcome.status = static_cast<SolveStatus>(static_cast<int>(status));
  outcome.message = comm.broadcast(outcome.message);
  double size = static_cast<double>(outcome.design.size());
  comm.broadcast(size);
  outcome.design.resize(static_cast<std::size_t>(size));
  comm.broadcast(outcome.design);
  context.result.message = outcome.message;
  if (outcome.design.empty()) return outcome.status;
  context.result.findings["optimization"] = outcome.findings;

  const std::vector<double> none(static_cast<std::size_t>(shape.bumps().variables()), 0.0);
  std::vector<double> amplitudes = none;
  std::copy_n(outcome.design.begin(), variables.bump_count(), amplitudes.begin());
  const double turn = variables.change(outcome.design)[Scalar::angle_of_attack];
  const SectionFolder sections[] = {write_section(context, "baseline", mesh, shape, none, 0.0),
                                    write_section(context, "optimum", mesh, shape, amplitudes, turn)};
  // What is found stays found, whatever becomes of the comparison.
  context.result.status = to_string(outcome.status);
  on_root(comm, [&] { context.result.write(context.output / "result.json"); });
  for (const std::string& verb : context.settings.optimize.compare) {
    if (verb != "steady" && !has_structure(context.settings)) {
      context.log.line("optimize.compare: {} is left out: the case has no [structure]", verb);
      continue;
    }
    for (const SectionFolder& section : sections) {
      if (context.stop.is_set()) return SolveStatus::interrupted;
      context.log.line("\n{}: {}", section.folder.filename().string(), verb);
      const Result result = run_verb_within(context, verb, section.settings, section.folder / verb);
      context.result.findings["comparison"][section.folder.filename().string()][verb] = {
          {"status", result.status}, {"message", result.message}};
    }
  }
  return outcome.status;
}

}  // namespace wingbeat
