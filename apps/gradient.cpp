#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "apps/case_mesh.hpp"
#include "apps/flow_setup.hpp"
#include "apps/gradient_output.hpp"
#include "apps/gradient_primal.hpp"
#include "apps/verbs.hpp"

namespace wingbeat {
namespace {

GmresOptions adjoint_options(const CaseSettings& settings) {
  GmresOptions options = gmres_options(settings.solver);
  options.relative_tolerance = settings.gradient.tolerance;
  return options;
}

GradientCheck run_check(Context& context, Objective<2>& objective, const DesignVariables& variables,
                        const std::vector<double>& gradient) {
  const auto part = context.timer.measure("check");
  const GradientSettings& settings = context.settings.gradient;
  GradientCheckOptions options{settings.difference_step, settings.max_differences,
                               gmres_options(context.settings.solver)};
  options.gmres.relative_tolerance = 1e-14;  // round-off ends it
  return check_gradient(context.comm, objective, variables, gradient, options, [&] {
    if (context.comm.any(context.stop.is_set()))
      throw SolveFailure(SolveStatus::interrupted, "stopped by a signal or --walltime during the check");
  });
}

// What a slope of first order differs by from that of second order (eq:onset-slope).
std::vector<double> onset_errors(const Comm& comm, const DesignVariables& variables,
                                 const std::vector<Parameters<2>>& terms, double energy) {
  // (-3, 4, -1)/(2 E) less (-1, 1, 0)/E.
  const auto difference = weighted_sum(terms, {-0.5 / energy, 1.0 / energy, -0.5 / energy});
  std::vector<double> errors = variables.derivatives(comm, difference);
  for (double& error : errors) error = std::abs(error);
  return errors;
}

}  // namespace

std::vector<std::string> gradient_sections(const CaseSettings& settings) {
  std::vector<std::string> sections{"mesh", "partition", "flow", "pitch", "solver", "design", "gradient"};
  const GradientSettings& gradient = settings.gradient;
  if (!gradient.is_of_loads())
    sections.insert(sections.end(), {"time", "structure", "flutter", "lco"});
  else if (gradient.analysis == "pitch")
    sections.push_back("time");
  return sections;
}

std::vector<std::string> gradient_faults(const CaseSettings& settings) {
  const GradientSettings& gradient = settings.gradient;
  std::vector<std::string> faults;
  if (gradient.is_of_loads()) {
    if (gradient.analysis == "pitch") {
      faults = pitch_faults(settings);
      if (gradient.harmonic == 0 && gradient.part == "imaginary")
        faults.push_back("gradient.part = \"imaginary\": the mean, gradient.harmonic = 0, is real; name a harmonic");
      if (gradient.harmonic > settings.time.harmonics)
        faults.push_back(fmt::format("gradient.harmonic = {}: the period has {} (time.harmonics)",
                                     gradient.harmonic, settings.time.harmonics));
    }
    if (gradient.analysis == "steady" && (gradient.harmonic != 0 || gradient.part != "real"))
      faults.push_back("gradient.harmonic: steady loads have none; set gradient.analysis to pitch");
    if (gradient.fixed_lift && (gradient.analysis == "pitch" || gradient.objective == "lift"))
      faults.push_back(
          "gradient.fixed_lift: holds the lift of steady drag or moment; set gradient.objective to drag or "
          "moment and gradient.analysis to steady");
    if (gradient.has("structure") && !has_structure(settings))
      faults.push_back("gradient.parameters: \"structure\" needs the section [structure]; give it, or leave it out");
    return faults;
  }
  if (gradient.fixed_lift)
    faults.push_back("gradient.fixed_lift: holds the lift of steady drag or moment, not of " + gradient.objective);
  const bool is_cycle = gradient.objective.starts_with("lco");
  if (is_cycle && gradient.is_of_given_speed() && !settings.lco.reduced_velocity)
    faults.push_back("lco.reduced_velocity: missing; gradient.objective = \"" + gradient.objective +
                     "\" is of the cycle at a given speed V (number, > 0)");
  if (is_cycle && !gradient.is_of_given_speed() && settings.lco.all_energies().size() != 1)
    faults.push_back(fmt::format("lco.energies: gradient.objective = \"{}\" is of the cycle of one given E_0, {} are "
                                 "given; give a list of one number",
                                 gradient.objective, settings.lco.all_energies().size()));
  return faults;
}

SolveStatus run_gradient(Context& context) {
  const CaseSettings& settings = context.settings;
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(settings.mesh));
  FlowLevel<2>& level = *levels.back();
  const ShapeVariables shape(level.mesh, level.local, settings.design);
  const DesignVariables variables(settings.gradient, shape, settings.design.bound);

  GradientPrimal primal = [&] {
    const auto part = context.timer.measure("primal");
    return solve_gradient_primal(context, levels, shape);
  }();
  if (primal.status != SolveStatus::converged) {
    const std::string why = context.result.message;
    context.result.message = fmt::format("{} has not converged: no gradient of {} is given{}{}",
                                         primal_name(settings), settings.gradient.objective,
                                         why.empty() ? "" : "; ", why);
    return primal.status;
  }

  GradientReport report;
  report.value = primal.objective.value() + primal.value_offset;
  std::vector<Parameters<2>> terms;
  {
    const auto part = context.timer.measure("gradient");
    {
      const auto solve = context.timer.measure("adjoint");
      report.adjoints = solve_adjoints(primal.objective, adjoint_options(settings));
    }
    {
      const auto contraction = context.timer.measure("contraction");
      terms = term_derivatives(primal.objective, report.adjoints);
    }
    const auto shape_part = context.timer.measure("shape");
    const auto sensitivity = weighted_sum(terms, primal.objective.weights());
    report.derivatives = variables.derivatives(context.comm, sensitivity);
    report.wall = shape.wall_sensitivity(context.comm, sensitivity.nodes);
    if (settings.gradient.has("nodes"))
      write_node_sensitivities(context, level.mesh, shape, sensitivity.nodes);
  }
  if (settings.gradient.objective == "onset_slope")
    report.errors = onset_errors(context.comm, variables, terms, settings.gradient.onset_energy);
  const GmresStatus status = report.adjoints.status();
  std::optional<SolveFailure> unchecked;
  if (context.check && status == GmresStatus::converged && variables.size() > 0) {
    try {
      report.check = run_check(context, primal.objective, variables, report.derivatives);
    } catch (const SolveFailure& failure) {
      unchecked = failure;
    }
  }
  report_gradient(context, variables, shape, report);
  if (unchecked) {
    context.result.message = fmt::format("the gradient stands unchecked: {}", unchecked->what());
    return unchecked->status();
  }
  if (status != GmresStatus::converged) {
    context.result.message = fmt::format(
        "the adjoint equations were solved to {:.1e}, not to gradient.tolerance = {:g} ({}); a longer "
        "solver.krylov_restart or more solver.max_linear_iterations may do",
        report.adjoints.relative_residual(), settings.gradient.tolerance, to_string(status));
    return SolveStatus::stalled;
  }
  if (context.check && variables.size() == 0)
    context.log.line("nothing was checked: gradient.parameters names no variables");
  context.result.message = fmt::format("{} = {:.8g}, derivatives with respect to {} parameters",
                                       settings.gradient.objective, report.value, variables.size());
  return SolveStatus::converged;
}

}  // namespace wingbeat
