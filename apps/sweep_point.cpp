#include "apps/sweep_point.hpp"

#include <chrono>

#include "apps/on_root.hpp"
#include "apps/run_case.hpp"
#include "apps/sub_run.hpp"
#include "core/io/file.hpp"

namespace wingbeat {
namespace {

constexpr double patience_seconds = 5.0;

SweepOutcome attempt(Context& outer, const Comm& group, FailureAgreement& agreement, const SweepTask& task,
                     const std::optional<Neighbour>& neighbour) {
  Log log = group.is_root() ? Log(task.folder / "log.txt") : Log(false);
  SubRun run(outer, group, task.verb, task.settings, task.folder, {&log, neighbour});
  std::string fault;
  try {
    run_recipe(find_verb(task.verb), run.context());
  } catch (const std::exception& error) {
    fault = error.what();
  }
  if (!fault.empty()) {
    // Where only some ranks have failed, the others may wait for them for ever.
    if (!agreement.all_failed(patience_seconds)) throw InternalError(fault);
    Result& failed = run.context().result;
    failed.status = "error";
    failed.message = fault;
    on_root(group, [&] { failed.write(task.folder / "result.json"); });
  }
  const Result& result = run.result();
  return {result.status, result.message, result.findings, neighbour.has_value(), 0.0};
}

}  // namespace

SweepOutcome run_sweep_point(Context& outer, const Comm& group, FailureAgreement& agreement,
                             const SweepTask& task) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  on_root(group, [&] {
    std::filesystem::create_directories(task.folder);
    write_file(task.folder / "case.toml", case_head(group, task.verb, "within " + outer.output.string()) +
                                              case_text(task.settings, outer.sources));
  });
  SweepOutcome outcome = attempt(outer, group, agreement, task, task.neighbour);
  const bool is_final = outcome.status == "converged" || outcome.status == "interrupted";
  if (task.neighbour && !is_final) outcome = attempt(outer, group, agreement, task, std::nullopt);
  outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return outcome;
}

}  // namespace wingbeat
