#pragma once

#include <optional>
#include <string>

#include "core/io/settings.hpp"

namespace wingbeat {

// [solver]: how the equations are solved, and how far.
struct SolverSettings {
  std::string method = "coupled";
  std::optional<std::string> flow_method;  // newton with a coupled method, runge_kutta with a staggered
  double newton_switch = 1e-4;
  std::optional<double> steady_tolerance;
  double flow_tolerance = 1e-10;
  double structure_tolerance = 1e-9;
  int max_steady_iterations = 200;
  int max_newton_iterations = 30;
  int max_linear_iterations = 400;
  int krylov_restart = 60;
  int krylov_deflation = 20;
  int overlap = 6;
  std::string subdomain = "lu";
  int ilu_fill = 2;
  int coarse_levels = 2;

  bool is_staggered() const { return method == "staggered"; }
  // The way the flow is solved by: flow_method, or what goes with the method.
  std::string flow_solver() const { return flow_method.value_or(is_staggered() ? "runge_kutta" : "newton"); }
  bool uses_cycles() const { return is_staggered() || flow_solver() != "newton"; }
  bool ends_with_newton() const { return flow_solver() != "runge_kutta"; }

  // What the steady flow is solved to: steady_tolerance, or what the way of solving can reach on any mesh.
  double steady_target() const { return steady_tolerance.value_or(ends_with_newton() ? 1e-11 : 1e-10); }

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
