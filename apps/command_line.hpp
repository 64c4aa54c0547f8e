#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace wingbeat {

// wingbeat VERB case.toml [section.key=value ...] [options], taken apart.
struct CommandLine {
  std::string verb;
  std::string target;  // the case file; for plot the folder of results
  std::vector<std::string> overrides;
  std::filesystem::path output;  // given or the default; empty for verbs without results
  std::optional<std::filesystem::path> restart;
  std::optional<double> walltime;  // seconds
  std::optional<int> ranks;        // to plan a partition for
  bool dry_run = false;
  bool markdown = false;
  bool find_flutter = false;
  bool check = false;
  bool retry_failed = false;

  std::string answer;  // what --help or --version asked for; there is nothing to run then
};

// Throws InputError saying what is wrong, with the nearest verb.
CommandLine parse_command_line(const std::vector<std::string>& arguments);

// ./CASENAME-VERB; CASENAME is the stem of the case file, or, where that is just case.toml, the
// name of the folder that holds it.
std::filesystem::path default_output(const std::filesystem::path& case_file, const std::string& verb);

}  // namespace wingbeat
