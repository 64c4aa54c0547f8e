#include "apps/sweep_point.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/earlier_run.hpp"
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
  SubRun run(outer, group, task.verb, task.settings, task.folder,
             {&log, start.neighbour, &task.kept_factors});
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

// Whether an attempt came to an end, and so leaves nothing to go on from.
bool has_ended(const fs::path& result) { return fs::exists(result) && status_in(result) != "interrupted"; }

// What an attempt that was stopped or killed left to go on from; empty where there is nothing.
std::string unfinished_attempt(const SweepTask& task) {
  if (!task.is_begun || has_ended(task.folder / "result.json")) return "";
  Log silent(false);
  try {
    return unfinished_run(task.folder, find_verb(task.verb), silent).string();
  } catch (const InputError&) {
    return "";  // damaged: the point begins anew
  }
}

// Makes the point's folder ready, and keeps in it only what there is to go on from.
std::string prepare_folder(const SweepTask& task, const std::string& case_file) {
  const std::string unfinished = unfinished_attempt(task);
  if (unfinished.empty()) fs::remove_all(task.folder);
  fs::remove(task.folder / "result.json");
  fs::create_directories(task.folder);
  write_file(task.folder / "case.toml", case_file);
  return unfinished;
}

}  // namespace

SweepOutcome run_sweep_point(Context& outer, const Comm& group, FailureAgreement& agreement,
                             const SweepTask& task) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  std::string unfinished;
  on_root(group, [&] {
    unfinished = prepare_folder(task, case_head(group, task.verb, "within " + outer.output.string()) +
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
  outcome.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return outcome;
}

}  // namespace wingbeat
