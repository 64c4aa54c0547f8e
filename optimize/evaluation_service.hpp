#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "optimize/design_solver.hpp"
#include "optimize/evaluation.hpp"

namespace wingbeat {

// Analyses of designs on all ranks, at the bidding of rank 0, where the optimiser runs. Ranks may form groups
// that each hold some of the analyses and work side by side; all outputs together are numbered group by
// group.
class EvaluationService {
 public:
  // `world`: all ranks; `group`: this rank's, whose analyses `solvers` are, one a group at least. Both are
  // kept by reference. `is_stopped`: collective over the world; polled before each evaluation. Collective.
  EvaluationService(const Comm& world, const Comm& group, std::vector<DesignSolver> solvers,
                    std::size_t variables, std::function<bool()> is_stopped);

  // One analysis more, or none, in each group. Collective.
  void add(std::vector<DesignSolver> solvers);

  // Names, on every rank.
  const std::vector<std::string>& analyses() const { return analysis_names_; }
  const std::vector<std::string>& outputs() const { return output_names_; }

  // On rank 0, while the others serve. A stop throws SolveFailure(interrupted) on every rank.
  Evaluation values(std::span<const double> design);
  GradientEvaluation gradients(std::span<const double> design);
  // Runs a task on every rank at a design; see serve.
  using Task = std::function<void(std::span<const double> design)>;
  void run(std::size_t number, std::span<const double> design);

  // Rank 0 runs `work`, and the others do as it asks until it ends. An InputError of `work` is thrown on
  // every rank, as an interruption is. Collective.
  void serve(std::vector<Task> tasks, const std::function<void()>& work);

 private:
  enum class Order { end, values, gradients, task };
  void call(Order order, std::size_t number, std::span<const double> design);
  void obey();
  Evaluation solve(std::span<const double> design);
  GradientEvaluation differentiate(std::span<const double> design);
  void number_outputs();
  void check_stop() const;

  const Comm& world_;
  const Comm& group_;
  std::vector<DesignSolver> solvers_;
  std::size_t variables_;
  std::function<bool()> is_stopped_;
  std::vector<Task> tasks_;
  std::vector<std::string> analysis_names_, output_names_;
  std::size_t first_analysis_ = 0, first_output_ = 0;  // of this group
};

}  // namespace wingbeat
