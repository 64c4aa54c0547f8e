#include "apps/advice.hpp"

#include <fmt/format.h>

namespace wingbeat {
namespace {

// What helps linear solves where factors are incomplete.
std::string factor_advice(const SolverSettings& settings) {
  if (settings.subdomain != "ilu") return "";
  return fmt::format("; with solver.subdomain = ilu raise solver.ilu_fill = {} or solver.krylov_restart = {}",
                     settings.ilu_fill, settings.krylov_restart);
}

}  // namespace

std::string steady_advice(SolveStatus status, const SolverSettings& settings) {
  switch (status) {
    case SolveStatus::converged:
      return "";
    case SolveStatus::iteration_limit:
      return fmt::format(
          "the steady flow did not reach solver.steady_tolerance = {} in solver.max_steady_iterations = {}; "
          "allow more if |R| in history.csv still falls, else relax the tolerance",
          settings.steady_target(), settings.max_steady_iterations);
    case SolveStatus::stalled:
      return "the steady flow stalled: no step lowers |R|; look at the mesh with `wingbeat mesh`, or lower "
             "flow.mach or the incidence" +
             factor_advice(settings);
    case SolveStatus::diverged:
      return "the steady flow diverged; look at the mesh with `wingbeat mesh`, or lower flow.mach or the "
             "incidence";
    case SolveStatus::interrupted:
      return "stopped by a signal or --walltime during the steady flow; run again with more time";
  }
  return "";
}

std::string coupled_advice(SolveStatus status, const SolverSettings& settings) {
  switch (status) {
    case SolveStatus::converged:
      return "";
    case SolveStatus::iteration_limit:
      return fmt::format(
          "Newton on the coupled problem needs more than solver.max_newton_iterations = {}; allow more and "
          "continue with --restart and this folder",
          settings.max_newton_iterations);
    case SolveStatus::stalled:
      return fmt::format(
          "Newton on the coupled problem stalled: no step lowers |F|; start from the solution of a smaller "
          "flutter.energy with --restart, or raise solver.max_linear_iterations = {} if that many were "
          "used{}",
          settings.max_linear_iterations, factor_advice(settings));
    case SolveStatus::diverged:
      return "Newton on the coupled problem diverged, or had no flow to start with; start from the solution "
             "of a smaller flutter.energy with --restart, go there by `wingbeat lco` with lco.energies in "
             "between, or use solver.method = staggered";
    case SolveStatus::interrupted:
      return "stopped by a signal or --walltime; continue with --restart and this folder";
  }
  return "";
}

std::string staggered_advice(SolveStatus status, const StaggeredSettings& settings) {
  switch (status) {
    case SolveStatus::converged:
      return "";
    case SolveStatus::iteration_limit:
      return fmt::format(
          "flow and structure need more than staggered.max_iterations = {} turns; allow more and continue "
          "with "
          "--restart and this folder, or let Newton finish with solver.flow_method = runge_kutta_newton",
          settings.max_iterations);
    case SolveStatus::stalled:
      return "flow and structure took turns without coming nearer; raise staggered.flow_cycles, start from "
             "the "
             "solution of a smaller amplitude with --restart, or use solver.method = coupled";
    case SolveStatus::diverged:
      return fmt::format(
          "the staggered iteration diverged with the relaxation halved staggered.max_recoveries = {} times; "
          "lower pseudo_time.cfl, raise staggered.flow_cycles, or start from the solution of a smaller "
          "amplitude with --restart",
          settings.max_recoveries);
    case SolveStatus::interrupted:
      return "stopped by a signal or --walltime; continue with --restart and this folder";
  }
  return "";
}

std::string forced_advice(SolveStatus status, const SolverSettings& settings) {
  switch (status) {
    case SolveStatus::converged:
      return "";
    case SolveStatus::iteration_limit:
      return fmt::format(
          "Newton on the forced motion needs more than solver.max_newton_iterations = {}; allow more and "
          "continue with --restart and this folder",
          settings.max_newton_iterations);
    case SolveStatus::stalled:
      return fmt::format(
          "Newton on the forced motion stalled: no step lowers |R|; start from the solution of a smaller "
          "amplitude with --restart, or raise solver.max_linear_iterations = {} if that many were used{}",
          settings.max_linear_iterations, factor_advice(settings));
    case SolveStatus::diverged:
      return "Newton on the forced motion diverged; start from the solution of a smaller amplitude with "
             "--restart";
    case SolveStatus::interrupted:
      return "stopped by a signal or --walltime; continue with --restart and this folder";
  }
  return "";
}

std::string general_advice(SolveStatus status) {
  if (status == SolveStatus::converged) return "";
  if (status == SolveStatus::interrupted)
    return "stopped by a signal or --walltime; run again with more time";
  return fmt::format("ended with {}; history.csv shows how far it came", to_string(status));
}

}  // namespace wingbeat
