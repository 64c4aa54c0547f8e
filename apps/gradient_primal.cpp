#include "apps/gradient_primal.hpp"

#include <fmt/format.h>

#include "adjoint/cycle_analysis.hpp"
#include "adjoint/flow_analysis.hpp"
#include "apps/cycle_branch.hpp"
#include "apps/cycle_record.hpp"
#include "apps/cycle_stage.hpp"
#include "apps/flow_setup.hpp"
#include "apps/pitch_stage.hpp"
#include "apps/solution_output.hpp"
#include "apps/steady_stage.hpp"
#include "structure/energy.hpp"

namespace wingbeat {
namespace {

// Newton's method of problems that start near their solutions.
NewtonOptions near_options(const SolverSettings& settings) {
  NewtonOptions options;
  options.max_iterations = settings.max_newton_iterations;
  options.gmres = gmres_options(settings);
  return options;
}

// The primal is as good as the case's tolerances ask for; with --check it goes on to round-off, so that
// differences of whole solutions mean something.
constexpr double check_flow_tolerance = 2e-12;
constexpr double check_structure_tolerance = 1e-12;

DomainBase<2> domain_base(const Context& context, const FlowLevel<2>& level, const ShapeVariables& shape) {
  return {context.comm,         level.local,         shape.nodes(),
          level.steady.model(), level.domain.axis(), has_structure(context.settings)};
}

LoadQuantity load_quantity(const GradientSettings& gradient) {
  LoadQuantity quantity;
  if (gradient.objective == "lift") quantity.coefficient = LoadCoefficient::lift;
  if (gradient.objective == "moment") quantity.coefficient = LoadCoefficient::moment;
  if (gradient.analysis == "pitch") {
    quantity.harmonic = gradient.harmonic;
    quantity.is_imaginary = gradient.part == "imaginary";
  }
  return quantity;
}

FlowAnalysisOptions load_options(const Context& context, double tolerance) {
  const CaseSettings& settings = context.settings;
  FlowAnalysisOptions options;
  options.objective = {{1.0, load_quantity(settings.gradient)}};
  if (const auto& reference = settings.flow.moment_reference)
    options.moment_reference = Vec<double, 2>{{{(*reference)[0], (*reference)[1]}}};
  options.tolerance = context.check ? std::min(check_flow_tolerance, tolerance) : tolerance;
  options.slack = std::max(1.0, tolerance / options.tolerance);
  options.newton = near_options(settings.solver);
  return options;
}

// J - chi C_L with chi = (dJ/d angle)/(dC_L/d angle): stationary in the angle, so that its derivatives are
// those of J where the angle holds the lift (eq:fixed-lift). Returns chi C_L.
double hold_lift(const Context& context, FlowAnalysis<2>& analysis, const ShapeVariables& shape) {
  const LoadQuantity quantity = load_quantity(context.settings.gradient), lift{LoadCoefficient::lift};
  Parameters<2> turn = no_change(shape.nodes());
  turn[Scalar::angle_of_attack] = 1.0;
  GmresOptions gmres = gmres_options(context.settings.solver);
  gmres.relative_tolerance = context.settings.gradient.tolerance;
  const auto slope = [&](const LoadQuantity& of) {
    analysis.choose({{1.0, of}});
    const auto derivative = directional_derivative(analysis.functional(), analysis.point(), turn, gmres);
    if (derivative.solve.status != GmresStatus::converged)
      throw SolveFailure(
          SolveStatus::stalled,
          fmt::format("the derivative by the angle of attack, which is to hold the lift, was solved to "
                      "{:.1e}, not to gradient.tolerance = {:g}; raise solver.max_linear_iterations = {}",
                      derivative.solve.relative_residual, gmres.relative_tolerance, gmres.max_iterations));
    return derivative.value;
  };
  const double by_angle = slope(quantity);
  const double lift_slope = slope(lift);
  if (std::abs(lift_slope) < 1e-6)
    throw SolveFailure(
        SolveStatus::stalled,
        fmt::format("the lift cannot be held by the angle of attack: it changes by {:.1e} a degree",
                    lift_slope));
  const double by_lift = by_angle / lift_slope;
  const double held = by_lift * analysis.functional().value();
  analysis.choose({{1.0, quantity}, {-by_lift, lift}});
  return held;
}

GradientPrimal steady_loads(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape,
                            History& history) {
  const SolverSettings& solver = context.settings.solver;
  FlowLevel<2>& level = *levels.back();
  GradientPrimal primal;
  if (context.restart) level.w = read_restart(context, level, {1}).w;
  primal.status = run_steady_stage(context, levels, history);
  if (primal.status != SolveStatus::converged) return primal;
  ForcedMotion rest;
  rest.mean_pitch = at_rest(context.settings).pitch;
  auto analysis = std::make_unique<FlowAnalysis<2>>(domain_base(context, level, shape), TimeSpectral(0), rest,
                                                    0.0, level.w, HarmonicFactors{level.solver, {}},
                                                    load_options(context, solver.steady_target()));
  analysis->solve(no_change(shape.nodes()));
  analysis->keep();
  if (context.settings.gradient.fixed_lift) primal.value_offset = hold_lift(context, *analysis, shape);
  primal.objective.terms.push_back({1.0, std::move(analysis)});
  return primal;
}

GradientPrimal forced_loads(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape,
                            History& history) {
  const CaseSettings& settings = context.settings;
  FlowLevel<2>& level = *levels.back();
  GradientPrimal primal;
  ForcedFlowStage stage = run_pitch_stage(context, levels, history, false);
  primal.status = stage.status;
  if (primal.status != SolveStatus::converged) return primal;
  const TimeSpectral time(settings.time.harmonics);
  if (!stage.flow.factors.mean)
    stage.flow.factors = unfactored(level.comm(), level.subdomain, state_size<2>, time.harmonics());
  auto analysis = std::make_unique<FlowAnalysis<2>>(
      domain_base(context, level, shape), time, forced_motion(settings.pitch),
      *settings.pitch.reduced_frequency, std::move(stage.flow.w), std::move(stage.flow.factors),
      load_options(context, settings.solver.flow_tolerance));
  analysis->solve(no_change(shape.nodes()));
  analysis->keep();
  primal.objective.terms.push_back({1.0, std::move(analysis)});
  return primal;
}

CycleQuantity cycle_quantity(const std::string& objective) {
  if (objective == "flutter_frequency" || objective == "lco_frequency") return CycleQuantity::frequency;
  if (objective == "lco_energy") return CycleQuantity::energy;
  if (objective == "lco_amplitude") return CycleQuantity::amplitude;
  return CycleQuantity::speed;
}

// Finds the cycles that an objective is a number of.
class CyclePrimal {
 public:
  CyclePrimal(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape, History& history)
      : context_(context),
        settings_(context.settings),
        levels_(levels),
        level_(*levels.back()),
        shape_(shape),
        history_(history),
        model_(structure_model(typical_section(settings_.structure))),
        solver_(context, level_, model_, history) {}

  GradientPrimal solve() {
    const std::string& objective = settings_.gradient.objective;
    if (objective == "onset_slope") return onset_slope();
    const bool is_flutter = objective.starts_with("flutter");
    if (is_flutter || settings_.solver.is_staggered()) return single(amplitude_of(objective));
    return on_branch();
  }

 private:
  CycleAmplitude amplitude_of(const std::string& objective) const {
    if (objective.starts_with("flutter")) return GivenEnergy{settings_.flutter.energy};
    if (!settings_.gradient.is_of_given_speed()) return GivenEnergy{settings_.lco.all_energies().front()};
    return GivenSpeed{*settings_.lco.reduced_velocity, settings_.flutter.energy};
  }

  std::optional<CycleStart> approach(double energy, GradientPrimal& primal) {
    CycleApproach found = approach_cycle(context_, levels_, model_, solver_, energy, history_);
    primal.status = found.status;
    return std::move(found.start);
  }

  // Straight from the start that linear flutter, or a restart, gives.
  GradientPrimal single(const CycleAmplitude& amplitude) {
    GradientPrimal primal;
    const auto* given = std::get_if<GivenEnergy>(&amplitude);
    const auto start = approach(given ? given->energy : settings_.flutter.energy, primal);
    if (!start) return primal;
    const CycleSolution solution = solver_.solve(stage_name(), *start, amplitude);
    if (finish(primal, solution)) add_term(1.0, solution, *start, primal);
    return primal;
  }

  // Along the branch from small motion, as the coupled method goes.
  GradientPrimal on_branch() {
    GradientPrimal primal;
    const LcoSettings& lco = settings_.lco;
    const bool by_speed = settings_.gradient.is_of_given_speed();
    const double energy = by_speed ? lco.max_energy : lco.all_energies().front();
    double first = std::min(settings_.flutter.energy, energy);
    const auto start = approach(first, primal);
    if (!start) return primal;
    if (context_.restart) first = fluctuating_energy(model_, start->state.y);
    CycleBranch branch(context_, model_, solver_, *start, energy);
    primal.status = branch.begin(first);
    BranchStep step = BranchStep::advanced;
    const auto is_there = [&] {
      if (by_speed) return CycleRecord::is_same(branch.reduced_velocity(), *lco.reduced_velocity);
      return CycleRecord::is_same(branch.energy(), energy);
    };
    if (primal.status == SolveStatus::converged && is_there()) step = BranchStep::reached;
    while (primal.status == SolveStatus::converged && step == BranchStep::advanced &&
           (!by_speed || branch.energy() < lco.max_energy))
      step = by_speed ? branch.advance_to_speed(*lco.reduced_velocity) : branch.advance_to_energy(energy);
    if (step == BranchStep::interrupted) primal.status = SolveStatus::interrupted;
    if (primal.status == SolveStatus::converged && step != BranchStep::reached) {
      primal.status = SolveStatus::stalled;
      context_.result.message =
          by_speed
              ? fmt::format(
                    "no cycle was found at lco.reduced_velocity = {:g}: the branch was followed to E_0 = "
                    "{:.3e}, V = {:.6f}; choose a speed that it reaches, or raise lco.max_energy = {:g}",
                    *lco.reduced_velocity, branch.energy(), branch.reduced_velocity(), lco.max_energy)
              : fmt::format(
                    "the cycle of lco.energies = {:g} was not reached: the branch was followed to E_0 = "
                    "{:.3e}, V = {:.6f}; a smaller energy, a finer mesh or other time.harmonics may do",
                    energy, branch.energy(), branch.reduced_velocity());
      return primal;
    }
    if (finish(primal, branch.solution())) add_term(1.0, branch.solution(), branch.start(), primal);
    return primal;
  }

  // dV/dE_0 at E from V at E, 2 E and 3 E, with an error of second order.
  GradientPrimal onset_slope() {
    GradientPrimal primal;
    const double energy = settings_.gradient.onset_energy;
    const std::array<double, 3> weights{-1.5, 2.0, -0.5};
    auto start = approach(energy, primal);
    for (std::size_t i = 0; start && i < weights.size(); ++i) {
      const CycleSolution solution = solver_.solve(fmt::format("cycle {} of 3", i + 1), *start,
                                                   GivenEnergy{energy * static_cast<double>(i + 1)});
      if (!finish(primal, solution)) return primal;
      add_term(weights[i] / energy, solution, *start, primal);
      if (i + 1 < weights.size())
        start = solver_.grown(solution.state, start->rest, energy * static_cast<double>(i + 2));
    }
    return primal;
  }

  // Reports a cycle; true where it converged.
  bool finish(GradientPrimal& primal, const CycleSolution& solution) {
    history_.write();
    const auto part = context_.timer.measure("output");
    primal.status = solution.status;
    write_solution_files(context_, level_, solution.state);
    const auto entry = cycle_entry(settings_, model_, solution);
    if (settings_.gradient.objective.starts_with("flutter"))
      context_.result.findings["flutter"] = entry;
    else
      context_.result.findings["lco"].push_back(entry);
    print_cycle(context_, entry);
    if (solution.status != SolveStatus::converged)
      context_.result.message = cycle_advice(settings_, solution);
    return solution.status == SolveStatus::converged;
  }

  void add_term(double weight, const CycleSolution& solution, const CycleStart& start,
                GradientPrimal& primal) {
    const auto part = context_.timer.measure("linearization");
    CycleAnalysisOptions options;
    options.quantity = cycle_quantity(settings_.gradient.objective);
    options.energy = fluctuating_energy(model_, solution.state.y);
    if (settings_.gradient.is_of_given_speed()) options.reduced_velocity = settings_.lco.reduced_velocity;
    const SolverSettings& solver = settings_.solver;
    options.tolerances = {solver.flow_tolerance, solver.structure_tolerance};
    options.slack = 1.0;
    if (context_.check) {
      options.tolerances = {std::min(check_flow_tolerance, solver.flow_tolerance),
                            std::min(check_structure_tolerance, solver.structure_tolerance)};
      options.slack = std::max(solver.flow_tolerance / options.tolerances.flow,
                               solver.structure_tolerance / options.tolerances.structure);
    }
    options.newton = near_options(solver);
    HarmonicFactors factors = start.factors;
    if (!factors.mean)
      factors =
          unfactored(level_.comm(), level_.subdomain, state_size<2>, time_of(solution.state).harmonics());
    auto analysis = std::make_unique<CycleAnalysis<2>>(
        domain_base(context_, level_, shape_), typical_section(settings_.structure),
        section_kinematics(settings_).mean_pitch, solution.state, start.rest, std::move(factors), options);
    analysis->solve(no_change(shape_.nodes()));
    analysis->keep();
    primal.objective.terms.push_back({weight, std::move(analysis)});
  }

  std::string stage_name() const {
    return settings_.gradient.objective.starts_with("flutter") ? "flutter" : "cycle";
  }

  Context& context_;
  const CaseSettings& settings_;
  FlowLevels<2>& levels_;
  FlowLevel<2>& level_;
  const ShapeVariables& shape_;
  History& history_;
  StructureModel model_;
  CycleSolver solver_;
};

}  // namespace

GradientPrimal solve_gradient_primal(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape) {
  const GradientSettings& gradient = context.settings.gradient;
  History history(context);
  if (!gradient.is_of_loads()) return CyclePrimal(context, levels, shape, history).solve();
  return gradient.analysis == "pitch" ? forced_loads(context, levels, shape, history)
                                      : steady_loads(context, levels, shape, history);
}

std::string primal_name(const CaseSettings& settings) {
  const GradientSettings& gradient = settings.gradient;
  if (gradient.is_of_loads())
    return gradient.analysis == "pitch" ? "the flow in forced motion" : "the steady flow";
  return gradient.objective.starts_with("flutter") ? "the flutter point" : "the limit cycle";
}

}  // namespace wingbeat
