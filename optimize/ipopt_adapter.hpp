#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "optimize/nonlinear_program.hpp"

namespace wingbeat {

struct IpoptOptions {
  int max_iterations = 100;
  double tolerance = 1e-4;  // of the optimality conditions, multipliers unscaled
  // That a step may lead to, of all constraints together; times that of the start where it is above one.
  double largest_violation = 1e4;
  std::vector<std::string> extra{};  // "name = value", of Ipopt's own options
};

enum class OptimizerStatus {
  converged,
  acceptable,  // within ten times the tolerance, and no better for many iterations
  iteration_limit,
  infeasible,        // where the violation of the constraints has a local minimum
  stalled,           // no better point, as after twenty trials in one iteration
  stopped,           // as observe asked, or at a limit of time among the extra options
  evaluation_failed  // at a point that Ipopt needs, or as it stalled
};

std::string_view to_string(OptimizerStatus status);

// Where the optimisation ended. Multipliers y, z_lower >= 0 and z_upper >= 0 are those of
// grad f + y^T grad g - z_lower + z_upper = 0; they are empty where Ipopt has none, as after failed
// evaluations.
struct OptimizerResult {
  OptimizerStatus status = OptimizerStatus::stalled;
  std::string message;  // why it ended
  int iterations = 0;
  std::vector<double> x;
  double objective = 0.0;  // NaN, and no constraints, where x itself could not be evaluated
  std::vector<double> constraints;
  std::vector<double> constraint_multipliers;
  std::vector<double> lower_multipliers, upper_multipliers;
  double kkt_error = 0.0;  // as ProgramIteration's; NaN where Ipopt has none
};

// Serial: for one rank, whose programme may lead others. Ipopt's lines go to print_line. Equal programmes
// have bit-identical iterates. Throws InputError for options that are at fault.
OptimizerResult run_ipopt(NonlinearProgram& program, const IpoptOptions& options,
                          const std::function<void(std::string_view)>& print_line);

// A sentence for each extra option that Ipopt does not know, that has a value it does not take, or that
// belongs to a key of the case.
std::vector<std::string> ipopt_option_faults(std::span<const std::string> extra);

}  // namespace wingbeat
