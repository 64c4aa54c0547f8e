#include "apps/sweep_point.hpp"

#include <chrono>
#include <filesystem>
#include <vector>

#include "apps/on_root.hpp"
#include "apps/restart_file.hpp"
#include "apps/run_case.hpp"
#include "apps/sub_run.hpp"
#include "core/io/error.hpp"
#include "core/io/file.hpp"

namespace wingbeat {

namespace fs = std::filesystem;

namespace {

constexpr double patience_seconds = 5.0;

// Where an attempt starts from, besides on its own.
struct Start {
  std::string unfinished{};  // what an earlier attempt left to go on from
  std::optional<Neighbour> neighbour{};
};

SweepOutcome attempt(Context& outer, const Comm& group, FailureAgreement& agreement, const SweepTask& task,
                     const Start& start) {
  Log log = group.is_root() ? Log(task.folder / "log.txt") : Log(false);
  SubRun run(outer, group, task.verb, task.settings, task.folder, {&log, start.neighbour});
  if (!start.unfinished.empty()) {
    run.context().restart = start.unfinished;
    run.context().is_restart_judged = true;
  }
  const std::string failure = failure_of([&] { run_recipe(find_verb(task.verb), run.context()); });
  if (!failure.empty()) {
    // Where only some ranks have failed, the others may wait for them for ever.
    if (!agreement.all_failed(patience_seconds)) throw_failure(failure);
    Result& failed = run.context().result;
    failed.status = "error";
    failed.message = message_of(failure);
    on_root(group, [&] { failed.write(task.folder / "result.json"); });
  }
  const Result& result = run.result();
  return {result.status, result.message, result.findings, start.neighbour.has_value(), 0.0};
}

// Whether an attempt came to an end that is not worth going on from.
bool has_failed(const fs::path& result) {
  if (!fs::exists(result)) return false;
  const auto found = nlohmann::json::parse(read_file(result), nullptr, false);
  return !found.is_object() || found.value("status", "") != "interrupted";
}

// Makes the point's folder ready: what an attempt at the same case that was stopped or killed left in it to
// go on from. Whatever else lies there is of another point, or failed, and is removed.
std::string prepare_folder(const SweepTask& task, const std::string& head, const std::string& text) {
  const fs::path case_file = task.folder / "case.toml", result = task.folder / "result.json";
  std::string unfinished;
  if (fs::is_regular_file(case_file) && read_file(case_file).ends_with(text) && !has_failed(result)) {
    Log silent(false);
    try {
      unfinished = unfinished_run(task.folder, find_verb(task.verb), silent).string();
    } catch (const InputError&) {  // it is damaged
    }
  }
  if (unfinished.empty()) fs::remove_all(task.folder);
  fs::remove(result);
  fs::create_directories(task.folder);
  write_file(case_file, head + text);
  return unfinished;
}

}  // namespace

SweepOutcome run_sweep_point(Context& outer, const Comm& group, FailureAgreement& agreement,
                             const SweepTask& task) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::string unfinished;
  on_root(group, [&] {
    unfinished = prepare_folder(task, case_head(group, task.verb, "within " + outer.output.string()),
                                case_text(task.settings, outer.sources));
  });
  unfinished = group.broadcast(unfinished);
  std::vector<Start> starts;
  if (!unfinished.empty()) starts.push_back({unfinished, task.neighbour});
  if (task.neighbour) starts.push_back({.neighbour = task.neighbour});
  starts.push_back({});
  SweepOutcome outcome;
  for (const Start& from : starts) {
    outcome = attempt(outer, group, agreement, task, from);
    if (outcome.status == "converged" || outcome.status == "interrupted") break;
  }
  outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return outcome;
}

}  // namespace wingbeat
