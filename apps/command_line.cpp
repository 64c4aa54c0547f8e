#include "apps/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "apps/verbs.hpp"
#include "apps/version.hpp"
#include "core/io/error.hpp"
#include "core/io/nearest_name.hpp"

namespace wingbeat {

namespace {

std::vector<std::string> verb_names() {
  std::vector<std::string> names;
  for (const auto& verb : verbs()) names.push_back(verb.name);
  names.insert(names.end(), {"plot", "reference"});
  return names;
}

void check_verb(const std::vector<std::string>& arguments) {
  if (!arguments.empty() && arguments.front().starts_with('-')) return;
  const auto names = verb_names();
  const std::string list = fmt::format("{}", fmt::join(names, ", "));
  if (arguments.empty()) throw InputError(fmt::format("no verb given; verbs: {}; see wingbeat --help", list));
  const std::string& verb = arguments.front();
  if (std::ranges::find(names, verb) != names.end()) return;
  const std::string nearest = nearest_name(verb, names);
  throw InputError(fmt::format("{}: unknown verb{}; verbs: {}", verb,
                               nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest), list));
}

// CLI11's own validator spells out the largest double.
std::string check_seconds(const std::string& text) {
  double seconds = 0.0;
  const bool is_number = CLI::detail::lexical_cast(text, seconds);
  return is_number && std::isfinite(seconds) && seconds > 0.0 ? "" : text + " is not a number of seconds > 0";
}

void add_case_verb(CLI::App& app, const Verb& verb, CommandLine& line) {
  CLI::App* command = app.add_subcommand(verb.name, verb.help);
  command->add_option("case", line.target, "case file")->required()->option_text("case.toml");
  command->add_option("overrides", line.overrides, "keys that replace those of the case")
      ->option_text("section.key=value ...");
  command->add_option("--output", line.output, "folder of the results (default ./CASENAME-VERB)")
      ->option_text("DIR");
  if (verb.can_restart)
    command->add_option("--restart", line.restart, "solution to go on from, or the folder it is in")
        ->option_text("PATH");
  command->add_option("--walltime", line.walltime, "stop after a checkpoint when this time is used up")
      ->option_text("SECONDS")
      ->check(check_seconds, "");
  command->add_flag("--dry-run", line.dry_run,
                    "print the resolved case and what it asks for; compute nothing");
  if (verb.name == "march")
    command->add_flag("--find-flutter", line.find_flutter,
                      "march at several speeds for that at which motion neither grows nor decays");
  if (verb.name == "gradient")
    command->add_flag("--check", line.check,
                      "compare the gradient with a tangent solve and with differences of whole solutions");
  if (verb.name == "sweep") {
    command
        ->add_option_function<int>(
            "--groups",
            [&line](int groups) { line.overrides.push_back(fmt::format("sweep.groups={}", groups)); },
            "groups of ranks that take points from one queue (the same as sweep.groups=G)")
        ->option_text("G")
        ->check(CLI::Range(1, 10'000'000));
    command->add_flag("--retry-failed", line.retry_failed, "try points again that failed in an earlier run");
  }
  if (verb.name == "partition")
    command->add_option("--ranks", line.ranks, "ranks to plan for (default: those that run)")
        ->option_text("N")
        ->check(CLI::Range(1, 10'000'000));
}

// CLI11's own words for a wrong option, without its advice on the program's name.
InputError command_line_error(const CLI::ParseError& error) {
  return InputError(fmt::format("command line: {}; see wingbeat --help", error.what()));
}

}  // namespace

CommandLine parse_command_line(const std::vector<std::string>& arguments) {
  check_verb(arguments);
  CommandLine line;
  CLI::App app("Transonic flutter and limit cycles of wings by a coupled time-spectral Newton solve.",
               "wingbeat");
  app.set_version_flag("--version", fmt::format("wingbeat {} ({})", version(), git_commit()));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 converged, 1 not converged, 2 bad input, 3 internal error, 4 stopped by a signal.");
  for (const auto& verb : verbs()) add_case_verb(app, verb, line);
  CLI::App* plot = app.add_subcommand("plot", "draw the results in a folder (Python with matplotlib)");
  plot->add_option("folder", line.target, "folder that a verb wrote")->required()->option_text("DIR");
  CLI::App* reference = app.add_subcommand("reference", "print all keys with units, defaults and ranges");
  reference->add_flag("--markdown", line.markdown, "as a page in Markdown");

  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    line.answer = app.help();
  } catch (const CLI::CallForVersion&) {
    line.answer = app.version() + "\n";
  } catch (const CLI::ParseError& error) {
    throw command_line_error(error);
  }
  if (!line.answer.empty()) return line;
  line.verb = app.get_subcommands().front()->get_name();
  const bool has_results = line.verb != "plot" && line.verb != "reference";
  if (has_results && line.output.empty()) line.output = default_output(line.target, line.verb);
  return line;
}

std::filesystem::path default_output(const std::filesystem::path& case_file, const std::string& verb) {
  const auto full = std::filesystem::absolute(case_file).lexically_normal();
  const bool named_by_folder = full.filename() == "case.toml" && full.parent_path().has_filename();
  const auto name = named_by_folder ? full.parent_path().filename() : full.stem();
  return name.string() + "-" + verb;
}

}  // namespace wingbeat
