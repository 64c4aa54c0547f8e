#include "apps/optimize_analyses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "apps/cycle_primal.hpp"
#include "apps/flow_setup.hpp"
#include "apps/load_primal.hpp"
#include "optimize/section_geometry.hpp"
#include "optimize/smooth_minimum.hpp"

namespace wingbeat {
namespace {

using Names = std::vector<std::string>;
using Kind = AnalysisPlan::Kind;

Names among(const Names& outputs, const Names& candidates) {
  Names result;
  for (const std::string& name : candidates)
    if (std::ranges::find(outputs, name) != outputs.end()) result.push_back(name);
  return result;
}

bool has(const Names& outputs, const std::string& name) {
  return std::ranges::find(outputs, name) != outputs.end();
}

std::string speed_at(double energy) { return fmt::format("lco_speed at E_0 = {:g}", energy); }
std::string onset_speed(int multiple) { return fmt::format("onset speed at {} E_0", multiple); }

OutputAnalysis loads_of(std::unique_ptr<FlowAnalysis<2>> analysis, const Names& outputs) {
  OutputAnalysis result{"steady", nullptr, {}};
  FlowAnalysis<2>* flow = analysis.get();
  const auto add = [&](const std::string& name, LoadCoefficient coefficient) {
    if (has(outputs, name))
      result.outputs.push_back({name, [flow, coefficient] { flow->choose({{1.0, {coefficient}}}); }});
  };
  add("drag", LoadCoefficient::drag);
  add("lift", LoadCoefficient::lift);
  add("moment", LoadCoefficient::moment);
  result.analysis = std::move(analysis);
  return result;
}

CycleQuantity quantity_of(const std::string& output) {
  if (output.ends_with("_frequency")) return CycleQuantity::frequency;
  if (output == "lco_amplitude") return CycleQuantity::amplitude;
  if (output == "lco_energy") return CycleQuantity::energy;
  return CycleQuantity::speed;
}

OutputAnalysis numbers_of(std::unique_ptr<CycleAnalysis<2>> analysis, std::string name,
                          const Names& outputs) {
  OutputAnalysis result{std::move(name), nullptr, {}};
  for (const std::string& output : outputs)
    result.outputs.push_back(
        {output, [cycle = analysis.get(), q = quantity_of(output)] { cycle->choose(q); }});
  result.analysis = std::move(analysis);
  return result;
}

// Takes over cycles, each under its name with its outputs.
void take(CyclePrimal::Cycles cycles, const std::vector<std::pair<std::string, Names>>& named,
          BaselineAnalyses& baseline) {
  baseline.status = cycles.status;
  if (cycles.status != SolveStatus::converged) return;
  for (std::size_t i = 0; i < named.size(); ++i)
    baseline.analyses.push_back(numbers_of(std::move(cycles.analyses[i]), named[i].first, named[i].second));
}

std::string cycle_name(double energy) { return fmt::format("cycle of E_0 = {:g}", energy); }

}  // namespace

std::vector<AnalysisPlan> plan_analyses(const CaseSettings& settings, const Names& outputs) {
  std::vector<AnalysisPlan> plans;
  const auto add = [&](Kind kind, Names of, double energy = 0.0) {
    if (!of.empty()) plans.push_back({kind, energy, std::move(of)});
  };
  std::vector<double> energies = settings.lco.all_energies();
  std::ranges::sort(energies);
  if (has(outputs, "onset_slope")) add(Kind::onset, {onset_speed(1), onset_speed(2), onset_speed(3)});
  if (has(outputs, "least_lco_speed"))
    for (const double energy : energies) add(Kind::cycle_of_energy, {speed_at(energy)}, energy);
  if (const Names of = among(outputs, {"lco_speed", "lco_frequency"}); !of.empty())
    add(Kind::cycle_of_energy, of, energies.front());
  add(Kind::cycle_at_speed, among(outputs, {"lco_amplitude", "lco_energy"}));
  add(Kind::flutter, among(outputs, {"flutter_speed", "flutter_frequency"}));
  add(Kind::steady, among(outputs, {"drag", "lift", "moment"}));
  return plans;
}

BaselineAnalyses solve_baseline(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape,
                                const std::vector<AnalysisPlan>& plans) {
  const CaseSettings& settings = context.settings;
  History history(context);
  // A case of loads alone has no structure to make it of.
  std::unique_ptr<CyclePrimal> made;
  const auto cycles = [&]() -> CyclePrimal& {
    if (!made) made = std::make_unique<CyclePrimal>(context, levels, shape, history);
    return *made;
  };
  BaselineAnalyses baseline;
  std::vector<double> energies;
  std::vector<std::pair<std::string, Names>> of_energies;
  for (const AnalysisPlan& plan : plans) {
    if (baseline.status != SolveStatus::converged) return baseline;
    switch (plan.kind) {
      case Kind::steady: {
        LoadPrimal loads = steady_primal(context, levels, shape, history, {});
        baseline.status = loads.status;
        if (loads.analysis) baseline.analyses.push_back(loads_of(std::move(loads.analysis), plan.outputs));
        break;
      }
      case Kind::flutter:
        take(cycles().flutter(), {{"flutter", plan.outputs}}, baseline);
        break;
      case Kind::cycle_at_speed: {
        const double v = *settings.lco.reduced_velocity;
        take(cycles().at_speed(v), {{fmt::format("cycle at V = {:g}", v), plan.outputs}}, baseline);
        break;
      }
      case Kind::onset:
        take(cycles().onset(settings.gradient.onset_energy),
             {{"onset 1", {plan.outputs[0]}}, {"onset 2", {plan.outputs[1]}}, {"onset 3", {plan.outputs[2]}}},
             baseline);
        break;
      case Kind::cycle_of_energy:
        energies.push_back(plan.energy);
        of_energies.emplace_back(cycle_name(plan.energy), plan.outputs);
        break;
    }
  }
  // One branch leads to all of them.
  if (baseline.status == SolveStatus::converged && !energies.empty())
    take(cycles().of_energies(energies), of_energies, baseline);
  return baseline;
}

std::vector<DerivedOutput> derived_outputs(const CaseSettings& settings, const Names& outputs) {
  std::vector<DerivedOutput> derived;
  if (has(outputs, "least_lco_speed")) {
    DerivedOutput least{"least_lco_speed", {}, {}};
    std::vector<double> energies = settings.lco.all_energies();
    std::ranges::sort(energies);
    for (const double energy : energies) least.of.push_back(speed_at(energy));
    least.combine = [sharpness = settings.optimize.sharpness, reference = 0.0](
                        std::span<const double> speeds, std::span<double> weights) mutable {
      if (reference == 0.0) reference = *std::ranges::min_element(speeds);  // asked of the baseline first
      const SmoothMinimum minimum = smooth_minimum(speeds, sharpness, reference);
      std::ranges::copy(minimum.derivatives, weights.begin());
      return minimum.value;
    };
    derived.push_back(std::move(least));
  }
  if (has(outputs, "onset_slope"))
    derived.push_back({"onset_slope",
                       {onset_speed(1), onset_speed(2), onset_speed(3)},
                       [weights = onset_weights(settings.gradient.onset_energy)](
                           std::span<const double> speeds, std::span<double> by) {
                         std::ranges::copy(weights, by.begin());
                         return weights[0] * speeds[0] + weights[1] * speeds[1] + weights[2] * speeds[2];
                       }});
  return derived;
}

std::vector<GeometricOutput> geometric_outputs(const ShapeVariables& shape, const Names& outputs) {
  std::vector<GeometricOutput> result;
  const auto add = [&](const std::string& name, SectionMeasure SectionMeasures::*member) {
    if (!has(outputs, name)) return;
    result.push_back({name, [&shape, member](std::span<const double> design, std::span<double> derivatives) {
                        const auto bumps = static_cast<std::size_t>(shape.bumps().variables());
                        const SectionMeasures measures =
                            measure_section(shape.wall(), shape.bumps().displacement(design.first(bumps)));
                        const SectionMeasure& measure = measures.*member;
                        std::ranges::fill(derivatives, 0.0);
                        std::ranges::copy(shape.amplitude_gradient(measure.by_wall), derivatives.begin());
                        return measure.value;
                      }});
  };
  add("area", &SectionMeasures::area);
  add("thickness", &SectionMeasures::thickness);
  add("leading_edge_radius", &SectionMeasures::leading_edge_radius);
  return result;
}

}  // namespace wingbeat
