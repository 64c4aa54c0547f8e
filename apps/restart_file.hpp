#pragma once

#include <filesystem>
#include <optional>

#include "apps/command_line.hpp"
#include "apps/verbs.hpp"
#include "core/io/log.hpp"
#include "core/parallel/comm.hpp"

namespace wingbeat {

// What a verb goes on from in a folder of its results: its record, or the newest solution that is whole; an
// empty path where there is none. Throws InputError where those that there are are damaged. Of one rank.
std::filesystem::path unfinished_run(const std::filesystem::path& folder, const Verb& verb, Log& log);

// The file that --restart means: itself or, of a folder of results, what the verb goes on from there: the
// newest solution that is whole. Nothing without --restart, and where the folder is that of this run and
// holds nothing yet: it then begins, so that a job can be put in the queue again whatever became of it.
// Throws InputError where there is no such file. Collective.
std::optional<std::filesystem::path> restart_file(const Comm& comm, const CommandLine& command,
                                                  const Verb& verb, Log& log);

}  // namespace wingbeat
