#pragma once

#include "apps/command_line.hpp"
#include "apps/verbs.hpp"
#include "core/parallel/comm.hpp"

namespace wingbeat {

enum ExitCode {
  exit_converged = 0,
  exit_not_converged = 1,
  exit_bad_input = 2,
  exit_internal = 3,
  exit_stopped = 4
};

const Verb& find_verb(const std::string& name);  // one that there is

// The case of a text for a verb. Throws InputError with all faults; those of overrides are blamed on their
// place.
ResolvedCase resolve_for_verb(const Verb& verb, const std::string& text, const std::string& path,
                              const std::vector<std::string>& overrides,
                              const std::string& override_place = "command line");

// Runs a verb's recipe, and writes its result.json with what it took. Collective.
SolveStatus run_recipe(const Verb& verb, Context& context);

// The first lines of a case.toml that a run leaves: version, ranks and where it came from.
std::string case_head(const Comm& comm, const std::string& verb, const std::string& case_path);

// Reads the case, runs the verb's recipe and leaves result.json in the output folder, whatever
// happens. Returns the exit code, the same on all ranks; a failure of some ranks only ends all.
int run_case(const Comm& comm, const CommandLine& command);

}  // namespace wingbeat
