#include "apps/flutter_branches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/analysis_setup.hpp"
#include "apps/cycle_primal.hpp"
#include "apps/flow_setup.hpp"
#include "apps/linear_flutter_output.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

FlutterRootOptions root_options(const Context& context) {
  const CaseSettings& settings = context.settings;
  return {{partition_options(settings), subdomain_options(settings.solver)},
          steady_options(settings.solver),
          linear_flutter_options(context)};
}

}  // namespace

FlutterBranches::FlutterBranches(Context& group, const FlowLevel<2>& level, const ShapeVariables& shape,
                                 const DesignVariables& variables)
    : context_(group),
      level_(level),
      shape_(shape),
      variables_(variables),
      model_(structure_model(typical_section(group.settings.structure))),
      roots_(domain_base(group, level, shape), level.mesh, shape, model_,
             section_kinematics(group.settings).mean_pitch, root_options(group)) {}

std::optional<std::vector<FlutterRoot>> FlutterBranches::roots(std::span<const double> design) {
  try {
    return roots_.roots(design.first(variables_.bump_count()), variables_.change(design));
  } catch (const SolveFailure& failure) {
    if (failure.status() == SolveStatus::interrupted) throw;
    return std::nullopt;
  }
}

OutputAnalysis FlutterBranches::analysis(std::span<const double> design, const FlutterRoot& wanted,
                                         const std::string& name) {
  const TimeSpectral time(context_.settings.time.harmonics);
  FlutterRootsAt::Polished start =
      roots_.polish(design.first(variables_.bump_count()), variables_.change(design), wanted, time,
                    context_.settings.flutter.energy);
  auto analysis = cycle_analysis(context_, level_, shape_, std::move(start.state), std::move(start.rest),
                                 unfactored(level_.comm(), level_.subdomain, state_size<2>, time.harmonics()),
                                 std::nullopt);
  analysis->solve(variables_.change(design));
  analysis->keep();
  OutputAnalysis result{name, nullptr, {}};
  result.outputs.push_back({name, [cycle = analysis.get()] { cycle->choose(CycleQuantity::speed); }});
  result.analysis = std::move(analysis);
  return result;
}

namespace {

bool holds_flutter(const std::vector<AnalysisPlan>& plans) {
  return std::ranges::any_of(plans,
                             [](const AnalysisPlan& p) { return p.kind == AnalysisPlan::Kind::flutter; });
}

// "flutter_speed 2", ...
std::string next_name(const std::vector<std::string>& outputs) {
  const auto held = std::ranges::count_if(
      outputs, [](const std::string& output) { return output.starts_with("flutter_speed"); });
  return fmt::format("flutter_speed {}", held + 1);
}

}  // namespace

BranchTasks::BranchTasks(Context& group, const Comm& world, const FlowLevel<2>& level,
                         const ShapeVariables& shape, const DesignVariables& variables,
                         const DesignSolverOptions& options, const std::vector<AnalysisPlan>& all,
                         const std::vector<AnalysisPlan>& own, EvaluationService& service)
    : context_(group),
      world_(world),
      shape_(shape),
      variables_(variables),
      options_(options),
      service_(service),
      is_own_(holds_flutter(own)) {
  if (holds_flutter(all)) branches_ = std::make_unique<FlutterBranches>(group, level, shape, variables);
}

std::vector<EvaluationService::Task> BranchTasks::tasks() {
  return {[this](std::span<const double> design) { found_ = branches_->roots(design); },
          [this](std::span<const double> design) { add(design); }};
}

RootService BranchTasks::root_service() {
  if (!branches_) return {};
  return {[this](std::span<const double> design) {
            service_.run(0, design);
            return found_;
          },
          [this](std::span<const double> design, const FlutterRoot& wanted) -> std::optional<std::string> {
            wanted_ = wanted;
            const std::string name = next_name(service_.outputs());
            service_.run(1, design);
            if (!is_added_) return std::nullopt;
            return name;
          }};
}

void BranchTasks::add(std::span<const double> design) {
  std::array<double, 2> root{wanted_.reduced_velocity, wanted_.frequency};
  world_.broadcast(root);
  wanted_.reduced_velocity = root[0];
  wanted_.frequency = root[1];
  std::vector<DesignSolver> more;
  bool has_failed = false;
  if (is_own_) try {
      more.emplace_back(context_.comm, branches_->analysis(design, wanted_, next_name(service_.outputs())),
                        std::vector<double>(design.begin(), design.end()), variables_, shape_, options_);
    } catch (const SolveFailure&) {
      has_failed = true;
    }
  is_added_ = !world_.any(has_failed);
  if (is_added_) service_.add(std::move(more));
}

}  // namespace wingbeat
