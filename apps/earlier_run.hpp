#pragma once

#include <filesystem>

namespace wingbeat {

// Clears a folder of results for another run. What the run before said of itself, case.toml, log.txt and
// result.json, goes to earlier/: a result there must not be taken for one of this run, nor be lost where
// this one is refused. What a failed run said goes, so that failures in turn do not push out what the last
// good one said.
void set_aside_earlier_run(const std::filesystem::path& folder);

}  // namespace wingbeat
