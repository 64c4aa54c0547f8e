#include "apps/optimize_root.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "core/io/csv.hpp"
#include "core/io/progress.hpp"
#include "optimize/ipopt_adapter.hpp"
#include "optimize/optimization_program.hpp"
#include "optimize/root_tracker.hpp"

namespace wingbeat {
namespace {

using nlohmann::ordered_json;

// Steps stay this near to what the constraints allow: the drag rises steeply, and there is nothing to be
// learnt far out.
constexpr double largest_violation = 0.1;
// Constraints are met to this, over their scales.
constexpr double feasible = 1e-4;

std::string short_number(double value) { return fmt::format("{:.6g}", value); }

// Lines of progress, optimization.csv and the record; remembers the best design that is feasible.
class IterationLog {
 public:
  IterationLog(Context& context, const OptimizationProblem& problem, const DesignOutputs& outputs,
               EvaluationRecord& record)
      : context_(context),
        problem_(problem),
        names_(outputs.names()),
        record_(record),
        progress_(std::make_unique<Progress>(context.log, "optimisation", columns())),
        table_(table_columns()) {}

  // From now on with the outputs that there are now; iterations go on counting.
  void begin_anew(const DesignOutputs& outputs) {
    names_ = outputs.names();
    earlier_ = count_;
    progress_ = std::make_unique<Progress>(context_.log, "optimisation", columns());
    table_ = CsvTable(table_columns());
  }

  void add(const DesignIteration& at) {
    count_ = earlier_ + at.program.iteration;
    std::vector<std::string> cells{fmt::format("{}", count_), short_number(at.objective)};
    for (const double value : at.outputs) cells.push_back(short_number(value));
    cells.insert(cells.end(),
                 {fmt::format("{:.1e}", at.violation), fmt::format("{:.1e}", at.program.kkt_error),
                  fmt::format("{:.1e}", at.program.step), fmt::format("{}", record_.evaluations())});
    if (at.program.iteration == 0) first_error_ = at.program.kkt_error;
    const OptimizeSettings& settings = context_.settings.optimize;
    const double of_error = converged_fraction(first_error_, at.program.kkt_error, settings.tolerance);
    const double of_limit = static_cast<double>(count_) / std::max(1, settings.max_iterations);
    progress_->row(cells, std::clamp(std::max(of_error, of_limit), 0.0, 1.0));

    std::vector<double> row{static_cast<double>(count_), at.objective};
    row.insert(row.end(), at.outputs.begin(), at.outputs.end());
    row.insert(row.end(), {at.violation, at.program.kkt_error, at.program.step, at.program.barrier,
                           static_cast<double>(at.program.trials), at.program.is_restoring ? 1.0 : 0.0,
                           static_cast<double>(record_.evaluations()), context_.timer.elapsed()});
    row.insert(row.end(), at.design.begin(), at.design.end());
    table_.add(row);
    table_.write(context_.output / "optimization.csv");
    record_.add_iteration({{"iteration", count_},
                           {"design", at.design},
                           {"objective", at.objective},
                           {"violation", at.violation},
                           {"kkt_error", at.program.kkt_error},
                           {"step", at.program.step},
                           {"is_restoring", at.program.is_restoring}});
    if (at.violation <= feasible && (!best_ || is_better(at.objective, best_->objective))) best_ = at;
  }
  const std::optional<DesignIteration>& best() const { return best_; }

 private:
  bool is_better(double a, double b) const { return problem_.is_maximized ? a > b : a < b; }

  std::vector<std::string> columns() const {
    std::vector<std::string> result{"iter", "objective"};
    result.insert(result.end(), names_.begin(), names_.end());
    result.insert(result.end(), {"violation", "KKT", "step", "designs"});
    return result;
  }
  std::vector<std::string> table_columns() const {
    std::vector<std::string> result{"iteration", "objective"};
    result.insert(result.end(), names_.begin(), names_.end());
    result.insert(result.end(), {"violation", "kkt_error", "step", "barrier", "trials", "is_restoring",
                                 "designs", "seconds"});
    result.insert(result.end(), problem_.space.names.begin(), problem_.space.names.end());
    return result;
  }

  Context& context_;
  const OptimizationProblem& problem_;
  std::vector<std::string> names_;
  EvaluationRecord& record_;
  std::unique_ptr<Progress> progress_;
  int earlier_ = 0, count_ = 0;
  CsvTable table_;
  double first_error_ = 1.0;
  std::optional<DesignIteration> best_;
};

SolveStatus solve_status(OptimizerStatus status) {
  switch (status) {
    case OptimizerStatus::converged:
    case OptimizerStatus::acceptable:
      return SolveStatus::converged;
    case OptimizerStatus::iteration_limit:
      return SolveStatus::iteration_limit;
    case OptimizerStatus::stopped:
      return SolveStatus::interrupted;
    default:
      return SolveStatus::stalled;
  }
}

ordered_json constraint_entries(const OptimizationProblem& problem, const DesignOutputs& outputs,
                                std::span<const double> initial, std::span<const double> final,
                                std::span<const double> multipliers) {
  ordered_json entries = ordered_json::object();
  for (std::size_t i = 0; i < problem.constraints.size(); ++i) {
    const Constraint& c = problem.constraints[i];
    const std::size_t o = outputs.index(c.output);
    ordered_json entry{{"output", c.output}};
    if (std::isfinite(c.lower)) entry["lower"] = c.lower;
    if (std::isfinite(c.upper)) entry["upper"] = c.upper;
    entry.update(
        ordered_json{{"initial", initial[o]}, {"final", final[o]}, {"violation", c.violation(final[o])}});
    if (i < multipliers.size()) entry["multiplier"] = multipliers[i];
    entries[c.text] = entry;
  }
  return entries;
}

ordered_json design_entries(const DesignSpace& space, std::span<const double> design) {
  ordered_json entries = ordered_json::array();
  for (std::size_t i = 0; i < design.size(); ++i) {
    const double margin = 1e-3 * space.scales[i];
    const char* at = design[i] <= space.lower[i] + margin   ? "lower"
                     : design[i] >= space.upper[i] - margin ? "upper"
                                                            : "";
    ordered_json entry{{"name", space.names[i]}, {"value", design[i]}};
    if (*at) entry["bound"] = at;
    entries.push_back(std::move(entry));
  }
  return entries;
}

void tell_start(Context& context, const ProblemStatement& statement, const OptimizationProblem& problem,
                const DesignOutputs& outputs, std::span<const double> start) {
  Log& log = context.log;
  log.line("\n{} over {} variables", statement.objective.text, problem.space.names.size());
  for (const Constraint& c : problem.constraints) {
    const double value = start[outputs.index(c.output)];
    const double violation = c.violation(value);
    log.line("  {}: {} = {:.8g} at the start{}", c.text, c.output, value,
             violation > feasible
                 ? fmt::format(", violated by {:.2g} of its scale: feasibility comes first", violation)
                 : "");
  }
}

// The optimiser, begun anew whenever a further flutter root has to be kept in view.
class OptimizationRun {
 public:
  OptimizationRun(Context& context, const ProblemStatement& statement, const OptimizationProblem& problem,
                  DesignOutputs& outputs, EvaluationRecord& record, const RootService& roots)
      : context_(context),
        statement_(statement),
        problem_(problem),
        outputs_(outputs),
        record_(record),
        roots_(roots),
        iterations_(context, problem, outputs, record),
        tracker_(context.settings.optimize.root_margin) {}

  OptimizationOutcome run(std::span<const double> baseline) {
    const OptimizeSettings& settings = context_.settings.optimize;
    std::vector<double> start = problem_.space.start;
    std::vector<std::string> branches;
    int iterations = 0;
    while (true) {
      newcomer_.reset();
      OptimizationProgram program(outputs_, problem_, start, flutter_output, branches,
                                  [&](const DesignIteration& at) { return observe(at); });
      const auto at = outputs_.values(start);
      const double allowed = std::max(largest_violation, 2.0 * (at ? program.violation(*at) : 0.0));
      const OptimizerResult result = run_ipopt(
          program, {settings.max_iterations - iterations, settings.tolerance, allowed, settings.ipopt},
          [&](std::string_view line) { context_.log.note(line); });
      iterations += result.iterations;
      if (result.status == OptimizerStatus::stopped && newcomer_ && iterations < settings.max_iterations) {
        start = last_;
        if (const auto name = roots_.add(start, *newcomer_)) {
          branches.push_back(*name);
          outputs_.refresh();
          iterations_.begin_anew(outputs_);
          context_.log.line("its speed is followed as {}: the least of {} roots counts from here on", *name,
                            branches.size() + 1);
        } else {
          context_.log.warn("that root was not found on the mesh itself and is left out of account");
        }
        continue;
      }
      return outcome(program, result, iterations, baseline);
    }
  }

 private:
  bool observe(const DesignIteration& at) {
    last_ = at.design;
    iterations_.add(at);
    if (!roots_.find) return true;
    if (!record_.roots(at.design)) {
      const auto found = roots_.find(at.design);
      if (!found) return true;
      record_.add(at.design, *found);
    }
    newcomer_ = tracker_.follow(*record_.roots(at.design));
    if (newcomer_)
      context_.log.line(
          "another flutter root comes near: V = {:.4f}, omega = {:.4f} beside V = {:.4f}, omega = {:.4f} "
          "(both "
          "linear, on every second node)",
          newcomer_->reduced_velocity, newcomer_->frequency, tracker_.known().front().reduced_velocity,
          tracker_.known().front().frequency);
    return !newcomer_;
  }

  OptimizationOutcome outcome(const OptimizationProgram& program, const OptimizerResult& result,
                              int iterations, std::span<const double> baseline) {
    OptimizationOutcome outcome;
    outcome.status = solve_status(result.status);
    const bool is_done = outcome.status == SolveStatus::converged;
    outcome.design = is_done || !iterations_.best() ? program.design(result.x) : iterations_.best()->design;
    const auto final = outputs_.values(outcome.design);
    if (!final) {
      outcome.message = "the final design was not solved: " + outputs_.why();
      outcome.status = SolveStatus::stalled;
      outcome.design.clear();
      return outcome;
    }
    // Asked again: a branch that came into view later has a value there, too.
    const std::vector<double> undeformed(problem_.space.names.size(), 0.0);
    const auto first = outputs_.values(undeformed);
    const double before = program.objective(first ? std::span<const double>(*first) : baseline);
    const double after = program.objective(*final);
    const std::string name =
        problem_.is_single() ? problem_.objective.front().output : statement_.objective.text;
    // A sum is of ratios already, and its baseline may be near zero.
    const std::string change = problem_.is_single()
                                   ? fmt::format("{:+.2f} %", 100.0 * (after - before) / std::abs(before))
                                   : fmt::format("{:+.4f}", after - before);
    outcome.message =
        fmt::format("{}: {} = {:.8g}, {} on the baseline {:.8g}, {} iterations, {} designs",
                    to_string(result.status), name, after, change, before, iterations, record_.evaluations());
    if (!is_done) outcome.message += "; " + result.message;
    outcome.findings = {{"objective", statement_.objective.text},
                        {"objective_initial", before},
                        {"objective_final", after},
                        {"constraints", constraint_entries(problem_, outputs_, baseline, *final,
                                                           result.constraint_multipliers)},
                        {"optimizer_status", to_string(result.status)},
                        {"kkt_error", result.kkt_error},
                        {"iterations", iterations},
                        {"evaluations", record_.evaluations()},
                        {"failed_evaluations", record_.failures()},
                        {"resumed_evaluations", record_.resumed()},
                        {"outputs_baseline", named(outputs_.names(), baseline)},
                        {"outputs_final", named(outputs_.names(), *final)},
                        {"seconds_of_values", record_.value_seconds()},
                        {"seconds_of_gradients", record_.gradient_seconds()},
                        {"design", design_entries(problem_.space, outcome.design)}};
    if (const auto& ratio = tracker_.next_ratio()) outcome.findings["next_root_ratio"] = *ratio;
    return outcome;
  }

  static constexpr const char* flutter_output = "flutter_speed";

  Context& context_;
  const ProblemStatement& statement_;
  const OptimizationProblem& problem_;
  DesignOutputs& outputs_;
  EvaluationRecord& record_;
  const RootService& roots_;
  IterationLog iterations_;
  RootTracker tracker_;
  std::vector<double> last_;
  std::optional<FlutterRoot> newcomer_;
};

}  // namespace

OptimizationOutcome optimize_on_root(Context& context, const ProblemStatement& statement,
                                     DesignOutputs& outputs, EvaluationRecord& record,
                                     const RootService& roots, DesignSpace space) {
  OptimizationOutcome outcome;
  const std::vector<double> undeformed(space.names.size(), 0.0);
  const auto baseline = outputs.values(undeformed);
  if (!baseline) {
    outcome.message = "the undeformed section was not solved again: " + outputs.why();
    return outcome;
  }
  const OptimizationProblem problem = make_problem(statement, outputs.names(), *baseline, std::move(space));
  const auto initial = outputs.values(problem.space.start);
  if (!initial) {
    outcome.message =
        fmt::format("the start design was not solved: {}; give a start nearer to zero", outputs.why());
    return outcome;
  }
  tell_start(context, statement, problem, outputs, *initial);
  return OptimizationRun(context, statement, problem, outputs, record, roots).run(*baseline);
}

}  // namespace wingbeat
