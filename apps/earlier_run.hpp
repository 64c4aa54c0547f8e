#pragma once

#include <filesystem>
#include <string>

namespace wingbeat {

// The status that a result.json tells; empty where it tells none. Throws InputError when it cannot be read.
std::string status_in(const std::filesystem::path& result);

// Makes a folder of results ready for another run. What the run before said of itself, case.toml, log.txt and
// result.json, is kept in earlier/, and its result removed: it must not be taken for one of this run, nor be
// lost where this one is refused. Nothing is kept of a run that failed, so that failures in turn do not push
// out what the last good one said.
void set_aside_earlier_run(const std::filesystem::path& folder);

}  // namespace wingbeat
