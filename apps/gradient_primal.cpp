#include "apps/gradient_primal.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "apps/cycle_primal.hpp"
#include "apps/flow_setup.hpp"
#include "apps/load_primal.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

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

GradientPrimal load_objective(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape,
                              History& history) {
  const GradientSettings& gradient = context.settings.gradient;
  const std::vector<WeightedLoad> objective{{1.0, load_quantity(gradient)}};
  LoadPrimal loads = gradient.analysis == "pitch" ? forced_primal(context, levels, shape, history, objective)
                                                  : steady_primal(context, levels, shape, history, objective);
  GradientPrimal primal;
  primal.status = loads.status;
  if (primal.status != SolveStatus::converged) return primal;
  if (gradient.fixed_lift) primal.value_offset = hold_lift(context, *loads.analysis, shape);
  primal.objective.terms.push_back({1.0, std::move(loads.analysis)});
  return primal;
}

CycleQuantity cycle_quantity(const std::string& objective) {
  if (objective == "flutter_frequency" || objective == "lco_frequency") return CycleQuantity::frequency;
  if (objective == "lco_energy") return CycleQuantity::energy;
  if (objective == "lco_amplitude") return CycleQuantity::amplitude;
  return CycleQuantity::speed;
}

CyclePrimal::Cycles solve_cycles(const CaseSettings& settings, CyclePrimal& primal) {
  const GradientSettings& gradient = settings.gradient;
  if (gradient.objective == "onset_slope") return primal.onset(gradient.onset_energy);
  if (gradient.objective.starts_with("flutter")) return primal.flutter();
  if (gradient.is_of_given_speed()) return primal.at_speed(*settings.lco.reduced_velocity);
  return primal.of_energies({settings.lco.all_energies().front()});
}

GradientPrimal cycle_objective(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape,
                               History& history) {
  const GradientSettings& gradient = context.settings.gradient;
  CyclePrimal solver(context, levels, shape, history);
  CyclePrimal::Cycles cycles = solve_cycles(context.settings, solver);
  GradientPrimal primal;
  primal.status = cycles.status;
  if (primal.status != SolveStatus::converged) return primal;
  std::vector<double> weights{1.0};
  if (gradient.objective == "onset_slope") {
    const auto slope = onset_weights(gradient.onset_energy);
    weights.assign(slope.begin(), slope.end());
  }
  for (std::size_t i = 0; i < cycles.analyses.size(); ++i) {
    cycles.analyses[i]->choose(cycle_quantity(gradient.objective));
    primal.objective.terms.push_back({weights[i], std::move(cycles.analyses[i])});
  }
  return primal;
}

}  // namespace

GradientPrimal solve_gradient_primal(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape) {
  History history(context);
  return context.settings.gradient.is_of_loads() ? load_objective(context, levels, shape, history)
                                                 : cycle_objective(context, levels, shape, history);
}

std::string primal_name(const CaseSettings& settings) {
  const GradientSettings& gradient = settings.gradient;
  if (gradient.is_of_loads())
    return gradient.analysis == "pitch" ? "the flow in forced motion" : "the steady flow";
  return gradient.objective.starts_with("flutter") ? "the flutter point" : "the limit cycle";
}

}  // namespace wingbeat
