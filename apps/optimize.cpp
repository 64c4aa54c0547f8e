#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/case_keys.hpp"
#include "apps/case_mesh.hpp"
#include "apps/flow_setup.hpp"
#include "apps/flutter_branches.hpp"
#include "apps/on_root.hpp"
#include "apps/optimize_analyses.hpp"
#include "apps/optimize_root.hpp"
#include "apps/optimum.hpp"
#include "apps/sub_run.hpp"
#include "apps/verbs.hpp"
#include "core/io/error.hpp"
#include "core/io/file.hpp"
#include "core/parallel/rank_texts.hpp"
#include "optimize/ipopt_adapter.hpp"
#include "optimize/optimization_program.hpp"

namespace wingbeat {
namespace {

constexpr const char* record_name = "evaluations.jsonl";

bool needs_cycles(const std::vector<AnalysisPlan>& plans) {
  return std::ranges::any_of(plans,
                             [](const AnalysisPlan& p) { return p.kind != AnalysisPlan::Kind::steady; });
}

// What all ranks know of the problem before anything is solved.
struct Setup {
  ProblemStatement statement;
  std::vector<std::string> named;  // outputs of the statement and those monitored
  std::vector<AnalysisPlan> plans;
};

Setup make_setup(const CaseSettings& settings) {
  Setup setup{problem_statement(settings.optimize), {}, {}};
  setup.named = setup.statement.outputs();
  for (const std::string& output : settings.optimize.monitor)
    if (std::ranges::find(setup.named, output) == setup.named.end()) setup.named.push_back(output);
  setup.plans = plan_analyses(settings, setup.named);
  return setup;
}

// Faces of the wall keep this part of their length.
constexpr double least_face = 0.25;

DesignSpace design_space(const Context& context, const DesignVariables& variables,
                         const ShapeVariables& shape) {
  const CaseSettings& settings = context.settings;
  DesignSpace space;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const double bound =
        i < variables.bump_count() ? settings.design.bound : settings.optimize.angle_bound_deg;
    space.names.push_back(variables.name(i));
    space.lower.push_back(-bound);
    space.upper.push_back(bound);
    space.scales.push_back(bound);
  }
  const auto& start = settings.optimize.start;
  if (!start.empty() && start.size() != variables.size())
    throw InputError(fmt::format("{}: {} numbers, but there are {} variables ({}{}); give one each",
                                 context.place("optimize.start"), start.size(), variables.size(),
                                 variables.name(0),
                                 variables.size() > 1 ? " to " + variables.name(variables.size() - 1) : ""));
  space.start = start.empty() ? std::vector<double>(variables.size(), 0.0) : start;
  for (std::size_t i = 0; i < space.start.size(); ++i)
    if (std::abs(space.start[i]) > space.upper[i])
      throw InputError(fmt::format("{}: {} = {:g} lies outside its bounds, {:g} to {:g}",
                                   context.place("optimize.start"), space.names[i], space.start[i],
                                   space.lower[i], space.upper[i]));
  if (variables.bump_count() > 0)
    space.limits = wall_limits(shape.wall(), shape.bumps(), settings.design.bound, least_face);
  return space;
}

// Values of the keys that the outputs depend on.
nlohmann::ordered_json record_keys(const CaseSettings& settings) {
  std::vector<std::string> sections = optimize_sections(settings);
  std::erase_if(sections, [](const std::string& name) { return name == "optimize" || name == "partition"; });
  return key_values(settings, sections);
}

}  // namespace

std::vector<std::string> optimize_sections(const CaseSettings& settings) {
  std::vector<std::string> sections{"mesh",   "partition", "flow",     "pitch",
                                    "solver", "design",    "gradient", "optimize"};
  if (statement_faults(settings.optimize).empty() && needs_cycles(make_setup(settings).plans))
    sections.insert(sections.end(), {"time", "structure", "flutter", "lco"});
  return sections;
}

std::vector<std::string> optimize_faults(const CaseSettings& settings) {
  const OptimizeSettings& optimize = settings.optimize;
  std::vector<std::string> faults = statement_faults(optimize);
  for (const std::string& fault : ipopt_option_faults(optimize.ipopt))
    faults.push_back("optimize.ipopt = " + fault);
  if (!faults.empty()) return faults;
  const Setup setup = make_setup(settings);
  const auto names = [&](const std::string& output) {
    return std::ranges::find(setup.named, output) != setup.named.end();
  };
  const std::size_t energies = settings.lco.all_energies().size();
  if ((names("lco_amplitude") || names("lco_energy")) && !settings.lco.reduced_velocity)
    faults.push_back(
        "lco.reduced_velocity: missing; lco_amplitude and lco_energy are of the cycle at a given speed V "
        "(number, > 0)");
  if ((names("lco_speed") || names("lco_frequency")) && energies != 1)
    faults.push_back(
        fmt::format("lco.energies: lco_speed and lco_frequency are of the cycle of one given E_0, {} are "
                    "given; give a list of one number, or use least_lco_speed",
                    energies));
  if (names("least_lco_speed") && energies == 0)
    faults.push_back("lco.energies: missing; least_lco_speed is the least over these (list of numbers, > 0)");
  if (std::ranges::find(optimize.compare, "lco") != optimize.compare.end())
    for (const std::string& fault : lco_faults(settings)) faults.push_back("optimize.compare: lco: " + fault);
  if (optimize.groups > static_cast<int>(std::max<std::size_t>(1, setup.plans.size())))
    faults.push_back(fmt::format("optimize.groups = {}: the problem has {} analyses; lower it",
                                 optimize.groups, setup.plans.size()));
  return faults;
}

SolveStatus run_optimize(Context& context) {
  const CaseSettings& settings = context.settings;
  const Setup setup = make_setup(settings);
  const int groups = std::min(settings.optimize.groups, context.comm.size());
  const int own_group = context.comm.rank() * groups / context.comm.size();
  const SplitComm group(context.comm, own_group);
  std::vector<AnalysisPlan> plans;
  for (std::size_t i = 0; i < setup.plans.size(); ++i)
    if (static_cast<int>(i) % groups == own_group) plans.push_back(setup.plans[i]);

  // Baseline, and all that is kept of it for the designs to come.
  const auto folder = context.output / "baseline";
  SubRun baseline(context, group.get(), "optimize", settings,
                  own_group == 0 ? folder : folder / fmt::format("group-{}", own_group + 1));
  on_root(group.get(), [&] { std::filesystem::create_directories(baseline.context().output); });
  FlowLevels<2> levels = make_levels<2>(baseline.context(), make_plane_mesh(context.comm, settings.mesh));
  FlowLevel<2>& level = *levels.back();
  const ShapeVariables shape(level.mesh, level.local, settings.design);
  const DesignVariables variables(settings.optimize.variables, shape, settings.design.bound);
  DesignSpace space = design_space(context, variables, shape);
  BaselineAnalyses analyses;
  std::string why;
  try {
    const auto part = context.timer.measure("baseline");
    analyses = solve_baseline(baseline.context(), levels, shape, plans);
    if (analyses.status != SolveStatus::converged) why = baseline.result().message;
  } catch (const SolveFailure& failure) {
    analyses.status = failure.status();
    why = failure.what();
  }
  const auto worst = static_cast<SolveStatus>(
      static_cast<int>(context.comm.max(static_cast<double>(static_cast<int>(analyses.status)))));
  if (worst != SolveStatus::converged) {
    context.result.message = "the undeformed section was not solved: " +
                             first_line(context.comm, group.get().is_root() ? why : "");
    return worst;
  }

  GmresOptions gmres = gmres_options(settings.solver);
  gmres.relative_tolerance = settings.gradient.tolerance;
  const DesignSolverOptions solver_options{gmres, settings.optimize.max_bisections};
  std::vector<DesignSolver> solvers;
  for (OutputAnalysis& analysis : analyses.analyses)
    solvers.emplace_back(group.get(), std::move(analysis), std::vector<double>(variables.size(), 0.0),
                         variables, shape, solver_options);
  EvaluationService service(context.comm, group.get(), std::move(solvers), variables.size(),
                            [&] { return context.stop.is_set(); });

  BranchTasks branches(baseline.context(), context.comm, level, shape, variables, solver_options, setup.plans,
                       plans, service);

  // Rank 0 optimises.
  OptimizationOutcome outcome;
  const auto part = context.timer.measure("optimization");
  try {
    service.serve(branches.tasks(), [&] {
      std::vector<std::string> earlier;
      if (context.restart) earlier = lines_of(read_file(*context.restart));
      EvaluationRecord record(context.output / record_name, record_keys(settings), service.analyses(),
                              service.outputs());
      if (context.restart) record.resume(earlier, context.restart->string());
      DesignOutputs outputs(service, record, derived_outputs(settings, setup.named),
                            geometric_outputs(shape, setup.named));
      outcome = optimize_on_root(context, setup.statement, outputs, record, branches.root_service(),
                                 std::move(space));
    });
  } catch (const SolveFailure& failure) {
    if (failure.status() != SolveStatus::interrupted) throw;
    context.result.message = fmt::format("{}; continue with --restart {}", failure.what(),
                                         (context.output / record_name).string());
    return SolveStatus::interrupted;
  }
  return finish_optimization(context, level.mesh, shape, variables, std::move(outcome));
}

}  // namespace wingbeat
