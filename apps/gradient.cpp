#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "apps/case_mesh.hpp"
#include "apps/flow_setup.hpp"
#include "apps/gradient_output.hpp"
#include "apps/gradient_primal.hpp"
#include "apps/verbs.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

GmresOptions adjoint_options(const CaseSettings& settings) {
  GmresOptions options = gmres_options(settings.solver);
  options.relative_tolerance = settings.gradient.tolerance;
  return options;
}

GradientCheck run_check(Context& context, Objective<2>& objective, const DesignVariables& variables,
                        const ShapeVariables& shape, const std::vector<double>& gradient) {
  const auto part = context.timer.measure("check");
  const GradientSettings& settings = context.settings.gradient;
  GradientCheckOptions options{settings.difference_step, settings.max_differences,
                               gmres_options(context.settings.solver)};
  options.gmres.relative_tolerance = 1e-14;  // round-off ends it
  return check_gradient(context.comm, objective, variables, shape, gradient, options, [&] {
    if (context.comm.any(context.stop.is_set()))
      throw SolveFailure(SolveStatus::interrupted, "stopped by a signal or --walltime during the check");
  });
}

// Far above what round-off and a sensible step leave, far below what a wrong term costs.
constexpr double transpose_limit = 1e-12, tangent_limit = 1e-6, difference_limit = 1e-3;

bool is_passed(const GradientCheck& check) {
  return check.transpose <= transpose_limit && check.tangent <= tangent_limit &&
         check.finite_difference <= difference_limit;
}

// What a slope of first order differs by from that of second order (eq:onset-slope).
std::vector<double> onset_errors(const Comm& comm, const DesignVariables& variables,
                                 const ShapeVariables& shape, const std::vector<Parameters<2>>& terms,
                                 double energy) {
  // (-3, 4, -1)/(2 E) less (-1, 1, 0)/E.
  const auto difference = weighted_sum(terms, {-0.5 / energy, 1.0 / energy, -0.5 / energy});
  std::vector<double> errors =
      variables.derivatives(shape.wall_sensitivity(comm, difference.nodes), difference);
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
  if (gradient.parameters.empty())
    faults.push_back(
        "gradient.parameters = []: nothing to differentiate by; name at least one of \"bumps\", \"mach\", "
        "\"angle_of_attack\", \"structure\", \"nodes\"");
  if (gradient.is_of_loads()) {
    if (gradient.analysis == "pitch") {
      for (const std::string& fault : pitch_faults(settings)) faults.push_back(fault);
      if (gradient.harmonic == 0 && gradient.part == "imaginary")
        faults.push_back(
            "gradient.part = \"imaginary\": the mean, gradient.harmonic = 0, is real; name a harmonic");
      if (gradient.harmonic > settings.time.harmonics)
        faults.push_back(
            fmt::format("gradient.harmonic = {}: the period has {}; lower it, or raise time.harmonics",
                        gradient.harmonic, settings.time.harmonics));
    }
    if (gradient.analysis == "steady" && (gradient.harmonic != 0 || gradient.part != "real"))
      faults.push_back(
          fmt::format("gradient.harmonic = {}, gradient.part = \"{}\": steady loads have no harmonics; set "
                      "gradient.analysis = "
                      "\"pitch\", or leave both out",
                      gradient.harmonic, gradient.part));
    if (gradient.fixed_lift && (gradient.analysis == "pitch" || gradient.objective == "lift"))
      faults.push_back(
          "gradient.fixed_lift: holds the lift of steady drag or moment; set gradient.objective to drag or "
          "moment and gradient.analysis to steady");
    if (gradient.has("structure") && !has_structure(settings))
      faults.push_back(
          "gradient.parameters: \"structure\" needs the section [structure]; give it, or leave it out");
    return faults;
  }
  if (gradient.fixed_lift)
    faults.push_back("gradient.fixed_lift: holds the lift of steady drag or moment, not of " +
                     gradient.objective);
  const StructureSettings& structure = settings.structure;
  const bool is_damped = structure.damping[0] != 0.0 || structure.damping[1] != 0.0;
  if (is_damped && structure.frequency_ratio == 1.0 && structure.static_unbalance == 0.0)
    faults.push_back(
        "structure.damping: the two vacuum frequencies are equal (frequency_ratio = 1, static_unbalance = "
        "0), and "
        "modal damping has no derivative there; change one of the three keys a little");
  const bool is_cycle = gradient.objective.starts_with("lco");
  if (is_cycle && gradient.is_of_given_speed() && !settings.lco.reduced_velocity)
    faults.push_back("lco.reduced_velocity: missing; gradient.objective = \"" + gradient.objective +
                     "\" is of the cycle at a given speed V (number, > 0)");
  if (is_cycle && !gradient.is_of_given_speed() && settings.lco.all_energies().size() != 1)
    faults.push_back(
        fmt::format("lco.energies: gradient.objective = \"{}\" is of the cycle of one given E_0, {} are "
                    "given; give a list of one number",
                    gradient.objective, settings.lco.all_energies().size()));
  return faults;
}

SolveStatus run_gradient(Context& context) {
  const CaseSettings& settings = context.settings;
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(context.comm, settings.mesh));
  FlowLevel<2>& level = *levels.back();
  const ShapeVariables shape(level.mesh, level.local, settings.design);
  const DesignVariables variables(settings.gradient.parameters, shape, settings.design.bound);

  GradientPrimal primal = [&] {
    const auto part = context.timer.measure("primal");
    return solve_gradient_primal(context, levels, shape);
  }();
  if (primal.status != SolveStatus::converged) {
    const std::string why = context.result.message;
    context.result.message =
        fmt::format("{} has not converged: no gradient of {} is given{}{}", primal_name(settings),
                    settings.gradient.objective, why.empty() ? "" : "; ", why);
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
    report.wall = shape.wall_sensitivity(context.comm, sensitivity.nodes);
    report.derivatives = variables.derivatives(report.wall, sensitivity);
    if (settings.gradient.has("nodes"))
      write_node_sensitivities(context, level.mesh, shape, sensitivity.nodes);
  }
  if (settings.gradient.objective == "onset_slope")
    report.errors = onset_errors(context.comm, variables, shape, terms, settings.gradient.onset_energy);
  const GmresStatus status = report.adjoints.status();
  std::optional<SolveFailure> unchecked;
  if (context.check && status == GmresStatus::converged && variables.size() > 0) {
    try {
      report.check = run_check(context, primal.objective, variables, shape, report.derivatives);
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
        "the adjoint equations were solved to {:.1e}, not to gradient.tolerance = {:g} ({}){}; raise "
        "solver.krylov_restart = {}, solver.krylov_deflation = {} or solver.max_linear_iterations = {}, or, "
        "near "
        "round-off, gradient.tolerance",
        report.adjoints.relative_residual(), settings.gradient.tolerance, to_string(status),
        context.check ? ": nothing was checked" : "", settings.solver.krylov_restart,
        settings.solver.krylov_deflation, settings.solver.max_linear_iterations);
    return SolveStatus::stalled;
  }
  if (report.check && !is_passed(*report.check)) {
    context.result.message = fmt::format(
        "the check of the gradient failed: transpose {:.1e} (at most {:g}), tangent {:.1e} (at most {:g}), "
        "differences {:.1e} (at most {:g}); where only the differences depart, try another "
        "gradient.difference_step = {:g} or a smaller design.bound = {:g}",
        report.check->transpose, transpose_limit, report.check->tangent, tangent_limit,
        report.check->finite_difference, difference_limit, settings.gradient.difference_step,
        settings.design.bound);
    return SolveStatus::stalled;
  }
  if (context.check && variables.size() == 0)
    context.log.line("nothing was checked: gradient.parameters names no variables");
  context.result.message = fmt::format("{} = {:.8g}, derivatives with respect to {} parameters",
                                       settings.gradient.objective, report.value, variables.size());
  return SolveStatus::converged;
}

}  // namespace wingbeat
