#pragma once

#include <string>

#include "apps/case_settings.hpp"
#include "core/algebra/newton.hpp"

namespace wingbeat {

// Why a solve ended as it did and what to change, in a sentence; empty where it converged.
std::string steady_advice(SolveStatus status, const SolverSettings& settings);
std::string coupled_advice(SolveStatus status, const SolverSettings& settings);
std::string staggered_advice(SolveStatus status, const StaggeredSettings& settings);
std::string forced_advice(SolveStatus status, const SolverSettings& settings);
// For a recipe that says nothing itself.
std::string general_advice(SolveStatus status);

}  // namespace wingbeat
