#include "optimize/evaluation_service.hpp"

#include <algorithm>
#include <chrono>

#include "core/algebra/newton.hpp"
#include "core/io/error.hpp"
#include "core/parallel/rank_texts.hpp"

namespace wingbeat {
namespace {

double seconds_since(std::chrono::steady_clock::time_point begun) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

// One name a line, of every group's first rank.
std::vector<std::string> all_names(const Comm& world, const Comm& group,
                                   const std::vector<std::string>& names) {
  std::string text;
  if (group.is_root())
    for (const std::string& name : names) text += name + "\n";
  return lines_of(joined(world, text));
}

// How many names the groups before this one have: groups are in rank order.
std::size_t offset_of(const Comm& world, const Comm& group, std::size_t count) {
  const std::vector<long> counts = world.all_gather(group.is_root() ? static_cast<long>(count) : 0L);
  long before = 0;
  for (int rank = 0; rank <= world.rank(); ++rank) before += counts[static_cast<std::size_t>(rank)];
  return static_cast<std::size_t>(before) - count;
}

}  // namespace

EvaluationService::EvaluationService(const Comm& world, const Comm& group, std::vector<DesignSolver> solvers,
                                     std::size_t variables, std::function<bool()> is_stopped)
    : world_(world),
      group_(group),
      solvers_(std::move(solvers)),
      variables_(variables),
      is_stopped_(std::move(is_stopped)) {
  number_outputs();
}

void EvaluationService::add(std::vector<DesignSolver> solvers) {
  for (DesignSolver& solver : solvers) solvers_.push_back(std::move(solver));
  number_outputs();
}

void EvaluationService::number_outputs() {
  std::vector<std::string> analyses, outputs;
  for (const DesignSolver& solver : solvers_) {
    analyses.push_back(solver.name());
    for (const AnalysisOutput& output : solver.outputs()) outputs.push_back(output.name);
  }
  analysis_names_ = all_names(world_, group_, analyses);
  output_names_ = all_names(world_, group_, outputs);
  first_analysis_ = offset_of(world_, group_, analyses.size());
  first_output_ = offset_of(world_, group_, outputs.size());
}

Evaluation EvaluationService::values(std::span<const double> design) {
  call(Order::values, 0, design);
  return solve(design);
}

GradientEvaluation EvaluationService::gradients(std::span<const double> design) {
  call(Order::gradients, 0, design);
  return differentiate(design);
}

void EvaluationService::run(std::size_t number, std::span<const double> design) {
  call(Order::task, number, design);
  check_stop();
  tasks_.at(number)(design);
}

void EvaluationService::serve(std::vector<Task> tasks, const std::function<void()>& work) {
  tasks_ = std::move(tasks);
  std::string fault;
  if (world_.is_root()) {
    try {
      work();
    } catch (const InputError& error) {
      fault = error.what();
    }
    call(Order::end, 0, {});
  } else {
    obey();
  }
  fault = world_.broadcast(fault);
  if (!fault.empty()) throw InputError(fault);
}

// An order, its number and the design, in one message.
void EvaluationService::call(Order order, std::size_t number, std::span<const double> design) {
  std::vector<double> message(2 + variables_, 0.0);
  message[0] = static_cast<double>(order);
  message[1] = static_cast<double>(number);
  std::ranges::copy(design, message.begin() + 2);
  world_.broadcast(message);
}

void EvaluationService::obey() {
  std::vector<double> message(2 + variables_);
  while (true) {
    world_.broadcast(message);
    const std::span<const double> design = std::span<const double>(message).subspan(2);
    switch (static_cast<Order>(message[0])) {
      case Order::end:
        return;
      case Order::values:
        solve(design);
        break;
      case Order::gradients:
        differentiate(design);
        break;
      case Order::task:
        check_stop();
        tasks_.at(static_cast<std::size_t>(message[1]))(design);
        break;
    }
  }
}

Evaluation EvaluationService::solve(std::span<const double> design) {
  check_stop();
  Evaluation result;
  result.values.resize(output_names_.size());
  result.seconds.resize(analysis_names_.size());
  double solves = 0.0;
  std::size_t output = first_output_;
  for (std::size_t a = 0; a < solvers_.size() && result.message.empty(); ++a) try {
      const DesignCost cost = solvers_[a].solve(design);
      const std::vector<double> values = solvers_[a].values();
      if (!group_.is_root()) continue;
      std::ranges::copy(values, result.values.begin() + static_cast<std::ptrdiff_t>(output));
      output += values.size();
      result.seconds[first_analysis_ + a] = cost.seconds;
      solves += cost.solves;
    } catch (const SolveFailure& failure) {
      result.message = failure.what();
    }
  result.message = first_line(world_, group_.is_root() ? result.message : std::string());
  result.is_solved = result.message.empty();
  world_.sum(result.values);
  world_.sum(result.seconds);
  result.solves = static_cast<int>(world_.sum(solves));
  return result;
}

GradientEvaluation EvaluationService::differentiate(std::span<const double> design) {
  check_stop();
  GradientEvaluation result;
  std::vector<double> flat(output_names_.size() * variables_);
  result.seconds.resize(analysis_names_.size());
  std::size_t position = first_output_ * variables_;
  for (std::size_t a = 0; a < solvers_.size() && result.message.empty(); ++a) try {
      const auto begun = std::chrono::steady_clock::now();
      const auto derivatives = solvers_[a].gradients(design);
      if (!group_.is_root()) continue;
      for (const auto& row : derivatives) {
        std::ranges::copy(row, flat.begin() + static_cast<std::ptrdiff_t>(position));
        position += variables_;
      }
      result.seconds[first_analysis_ + a] = seconds_since(begun);
    } catch (const SolveFailure& failure) {
      result.message = failure.what();
    }
  result.message = first_line(world_, group_.is_root() ? result.message : std::string());
  result.is_solved = result.message.empty();
  world_.sum(flat);
  world_.sum(result.seconds);
  for (std::size_t o = 0; o < output_names_.size(); ++o) {
    const auto row = flat.begin() + static_cast<std::ptrdiff_t>(o * variables_);
    result.derivatives.emplace_back(row, row + static_cast<std::ptrdiff_t>(variables_));
  }
  return result;
}

void EvaluationService::check_stop() const {
  if (is_stopped_())
    throw SolveFailure(SolveStatus::interrupted, "stopped by a signal or --walltime during the optimisation");
}

}  // namespace wingbeat
