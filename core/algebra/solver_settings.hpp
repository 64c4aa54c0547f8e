#pragma once

#include <string>

#include "core/io/settings.hpp"

namespace wingbeat {

// [solver]: how the equations are solved, and how far.
struct SolverSettings {
  std::string method = "coupled";
  double steady_tolerance = 1e-11;
  double flow_tolerance = 1e-10;
  double structure_tolerance = 1e-9;
  int max_steady_iterations = 200;
  int max_newton_iterations = 30;
  int max_linear_iterations = 400;
  int krylov_restart = 60;
  int overlap = 6;
  int coarse_levels = 2;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
