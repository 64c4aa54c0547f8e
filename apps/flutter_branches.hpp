#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adjoint/design_variables.hpp"
#include "adjoint/shape_variables.hpp"
#include "apps/context.hpp"
#include "apps/optimize_analyses.hpp"
#include "flow/flow_level.hpp"
#include "optimize/evaluation_service.hpp"
#include "optimize/flutter_roots_at.hpp"

namespace wingbeat {

// The roots of the linear flutter problem at designs, and analyses of those that the optimiser must know of.
class FlutterBranches {
 public:
  // `group`: context of the ranks that share a design's analyses. All is kept by reference.
  FlutterBranches(Context& group, const FlowLevel<2>& level, const ShapeVariables& shape,
                  const DesignVariables& variables);

  // All roots; nothing where the steady flow behind them was not found. Collective over the group.
  std::optional<std::vector<FlutterRoot>> roots(std::span<const double> design);
  // The cycle of flutter.energy at the root nearest to `wanted`, solved at the design, with its speed as the
  // output `name`. Collective over the group; throws SolveFailure.
  OutputAnalysis analysis(std::span<const double> design, const FlutterRoot& wanted, const std::string& name);

 private:
  Context& context_;
  const FlowLevel<2>& level_;
  const ShapeVariables& shape_;
  const DesignVariables& variables_;
  StructureModel model_;
  FlutterRootsAt roots_;
};

// What rank 0 may ask of all ranks about flutter roots; empty where the problem has no flutter point.
struct RootService {
  std::function<std::optional<std::vector<FlutterRoot>>(std::span<const double> design)> find;
  // A further output, the speed at the root nearest to the one wanted; its name, or nothing where it was not
  // found.
  std::function<std::optional<std::string>(std::span<const double> design, const FlutterRoot& wanted)> add;
};

// The same as tasks of an evaluation service.
class BranchTasks {
 public:
  // `all`: analyses of all groups; `own`: of this rank's.
  BranchTasks(Context& group, const Comm& world, const FlowLevel<2>& level, const ShapeVariables& shape,
              const DesignVariables& variables, const DesignSolverOptions& options,
              const std::vector<AnalysisPlan>& all, const std::vector<AnalysisPlan>& own,
              EvaluationService& service);
  BranchTasks(const BranchTasks&) = delete;
  BranchTasks& operator=(const BranchTasks&) = delete;

  std::vector<EvaluationService::Task> tasks();
  RootService root_service();

 private:
  void add(std::span<const double> design);

  Context& context_;
  const Comm& world_;
  const ShapeVariables& shape_;
  const DesignVariables& variables_;
  DesignSolverOptions options_;
  EvaluationService& service_;
  std::unique_ptr<FlutterBranches> branches_;
  bool is_own_;  // this rank's group holds the flutter point
  FlutterRoot wanted_;
  std::optional<std::vector<FlutterRoot>> found_;
  bool is_added_ = false;
};

}  // namespace wingbeat
