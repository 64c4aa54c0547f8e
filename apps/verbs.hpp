#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/context.hpp"
#include "core/algebra/newton.hpp"

namespace wingbeat {

// A recipe computes what its verb promises, writes its files into context.output (rank 0) and
// fills context.result. It is collective. It returns how the solution ended; the caller writes
// result.json and turns the status into the exit code. Faults of the input are InputError.
SolveStatus run_steady(Context& context);
SolveStatus run_pitch(Context& context);
SolveStatus run_flutter(Context& context);
SolveStatus run_lco(Context& context);
SolveStatus run_march(Context& context);
SolveStatus run_pk(Context& context);
SolveStatus run_gradient(Context& context);
SolveStatus run_optimize(Context& context);
SolveStatus run_sweep(Context& context);
SolveStatus run_mesh(Context& context);
SolveStatus run_partition(Context& context);

// What is wrong with a case for that verb beyond single sections: "section.key: ...", what to do.
std::vector<std::string> pitch_faults(const CaseSettings& settings);
std::vector<std::string> lco_faults(const CaseSettings& settings);
std::vector<std::string> pk_faults(const CaseSettings& settings);
std::vector<std::string> gradient_faults(const CaseSettings& settings);
std::vector<std::string> optimize_faults(const CaseSettings& settings);
std::vector<std::string> sweep_faults(const CaseSettings& settings);

// The sections that pk needs: those of mesh and flow unless Q(k) is read from a file.
std::vector<std::string> pk_sections(const CaseSettings& settings);
// The sections that a gradient needs: those of the verb that its objective is a number of.
std::vector<std::string> gradient_sections(const CaseSettings& settings);
// The sections that an optimisation needs: those of the outputs it names.
std::vector<std::string> optimize_sections(const CaseSettings& settings);
// What a sweep would do, in a line; throws InputError where a point's case has faults.
std::string sweep_plan(const ResolvedCase& resolved);
// The case of its point with the largest mesh.
CaseSettings largest_sweep_case(const ResolvedCase& resolved);

// A verb of the command line that works on a case.
struct Verb {
  std::string name;
  std::string help;
  std::vector<std::string> sections;  // whose required keys the case must give
  SolveStatus (*run)(Context&);
  bool can_restart = false;
  std::vector<std::string> (*faults)(const CaseSettings&) = nullptr;
  std::vector<std::string> (*sections_of)(const CaseSettings&) = nullptr;  // where the case decides
  std::string (*plan)(const ResolvedCase&) = nullptr;                      // what --dry-run says more
  CaseSettings (*largest_case)(const ResolvedCase&) = nullptr;             // of several that it works on
  std::string record{};  // the file that it goes on from, where that is not solution.cgns
};

std::span<const Verb> verbs();

}  // namespace wingbeat
