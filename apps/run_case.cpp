#include "apps/run_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "apps/advice.hpp"
#include "apps/breakdown.hpp"
#include "apps/case_mesh.hpp"
#include "apps/earlier_run.hpp"
#include "apps/flow_setup.hpp"
#include "apps/memory_estimate.hpp"
#include "apps/on_root.hpp"
#include "apps/restart_file.hpp"
#include "apps/timing.hpp"
#include "apps/verbs.hpp"
#include "apps/version.hpp"
#include "core/io/case_file.hpp"
#include "core/io/counted.hpp"
#include "core/io/error.hpp"
#include "core/io/file.hpp"
#include "core/io/folder_lock.hpp"
#include "core/io/memory.hpp"
#include "core/parallel/failure_agreement.hpp"
#include "core/parallel/node.hpp"

namespace wingbeat {

namespace fs = std::filesystem;

namespace {

struct Failure {
  int exit_code = exit_internal;
  std::string message;
};

int exit_code_of(SolveStatus status) {
  if (status == SolveStatus::converged) return exit_converged;
  return status == SolveStatus::interrupted ? exit_stopped : exit_not_converged;
}

// Rank 0 reads, so that every rank sees the same text and finds the same faults.
ResolvedCase read_case(const Comm& comm, const CommandLine& command, const Verb& verb) {
  std::string text;
  on_root(comm, [&] { text = read_case_text(command.target); });
  text = comm.broadcast(text);
  return resolve_for_verb(verb, text, command.target, command.overrides);
}

void prepare_output(const Comm& comm, const CommandLine& command, const ResolvedCase& resolved, Log& log) {
  on_root(comm, [&] {
    remove_unfinished(command.output);
    write_file(command.output / "case.toml", case_head(comm, command.verb, command.target) + resolved.text);
    log.copy_to(command.output / "log.txt");
  });
}

// Groups of ranks that each hold a mesh of their own.
int groups_of(const std::string& verb, const CaseSettings& settings) {
  if (verb == "sweep") return settings.sweep.groups;
  return verb == "optimize" ? settings.optimize.groups : 1;
}

// What a run would work on, and the memory that it would take. Making the mesh finds its faults, too.
void show_plan(const Comm& comm, const Verb& verb, const ResolvedCase& resolved, Log& log) {
  log.line(resolved.text);
  if (verb.plan) log.line("# {}", verb.plan(resolved));
  const CaseSettings settings = verb.largest_case ? verb.largest_case(resolved) : resolved.settings;
  if (!settings.mesh.airfoil && !settings.mesh.file) return;
  const double process = comm.max(resident_bytes());
  const int groups = std::min(groups_of(verb.name, resolved.settings), comm.size());
  const int ranks = comm.size() / groups, instances = 2 * settings.time.harmonics + 1;
  std::visit(
      [&]<int Dim>(const MultiblockMesh<Dim>& mesh) {
        log.line("# {} cells in {}", mesh.cell_count(), counted(mesh.zones.size(), "block"));
        const auto partition = partition_mesh(mesh, ranks, partition_options(settings));
        const auto statistics = partition_statistics(mesh, partition, instances);
        auto memory = estimate_memory(verb.name, settings, mesh.cell_count(), statistics, process);
        memory.all_ranks *= groups;
        log.line("# memory: about {}", memory_text(memory, comm.size()));
      },
      make_case_mesh(comm, settings.mesh));
}

// The most memory that the ranks ever held, each at its own time.
void report_memory(Context& context) {
  constexpr double megabyte = 1e6;
  const double own = peak_resident_bytes() / megabyte;
  const double sum = context.comm.sum(own), largest = context.comm.max(own);
  auto& memory = context.result.findings["memory"];
  memory["peak_megabytes"] = sum;
  memory["largest_rank_megabytes"] = largest;
  context.log.line("memory at the most: {:.0f} MB on all ranks, {:.0f} MB on the largest", sum, largest);
}

void finish(Context& context) {
  const auto timings = gather_timings(context.comm, context.timer);
  for (const auto& timing : timings) context.result.wall_seconds.emplace_back(timing.path, timing.maximum);
  context.log.line(timing_table(timings));
  report_memory(context);
  on_root(context.comm, [&] { context.result.write(context.output / "result.json"); });
  context.log.line("{} {}: results in {}", context.result.command, context.result.status,
                   context.output.string());
}

int execute(const Comm& comm, const CommandLine& command, Result& result, Timer& timer) {
  const Verb& verb = find_verb(command.verb);
  if (!command.dry_run) on_root(comm, [&] { set_aside_earlier_run(command.output); });
  const ResolvedCase resolved = read_case(comm, command, verb);
  Log log(comm.is_root());
  if (command.dry_run) {
    show_plan(comm, verb, resolved, log);
    return exit_converged;
  }
  prepare_output(comm, command, resolved, log);
  const auto restart = restart_file(comm, command, verb, log);
  const StopRequest stop(comm, command.walltime);
  Checkpoints checkpoints(comm, stop, resolved.settings.checkpoint, log);
  Context context{.comm = comm,
                  .settings = resolved.settings,
                  .sources = resolved.sources,
                  .output = command.output,
                  .restart = restart,
                  .neighbour = std::nullopt,
                  .find_flutter = command.find_flutter,
                  .check = command.check,
                  .retry_failed = command.retry_failed,
                  .planned_ranks = command.ranks.value_or(comm.size()),
                  .node_ranks = ranks_on_node(comm),
                  .log = log,
                  .timer = timer,
                  .result = result,
                  .stop = stop,
                  .checkpoints = checkpoints,
                  .is_restart_judged = true};
  return exit_code_of(run_recipe(verb, context));
}

void write_failure(const CommandLine& command, Result& result, const Timer& timer,
                   const std::string& message) {
  result.status = "error";
  result.message = message;
  result.wall_seconds = {{"total", timer.elapsed()}};
  try {
    result.write(command.output / "result.json");
  } catch (const std::exception& error) {
    fmt::print(stderr, "wingbeat: {}\n", error.what());
  }
}

}  // namespace

SolveStatus run_recipe(const Verb& verb, Context& context) {
  // A stage that a recipe cannot do without may end unsolved: the run then ends so, too.
  const SolveStatus status = [&] {
    try {
      return verb.run(context);
    } catch (const SolveFailure& failure) {
      context.result.message = failure.what();
      return failure.status();
    }
  }();
  Result& result = context.result;
  result.status = to_string(status);
  if (result.message.empty()) result.message = general_advice(status);
  if (status == SolveStatus::diverged) result.message = with_breakdown(result);
  if (status != SolveStatus::converged) context.log.warn(result.message);
  finish(context);
  return status;
}

ResolvedCase resolve_for_verb(const Verb& verb, const std::string& text, const std::string& path,
                              const std::vector<std::string>& overrides, const std::string& override_place) {
  const auto used_sections = [&](const CaseSettings& settings) {
    return verb.sections_of ? verb.sections_of(settings) : verb.sections;
  };
  ResolvedCase resolved =
      resolve_case(text, path, overrides, used_sections, "wingbeat " + verb.name, override_place);
  if (!verb.faults) return resolved;
  const std::vector<std::string> faults = verb.faults(resolved.settings);
  if (faults.size() == 1) throw InputError(fmt::format("{}: {}", path, faults[0]));
  if (!faults.empty())
    throw InputError(fmt::format("{} faults in the case:\n  {}: {}", faults.size(), path,
                                 fmt::join(faults, fmt::format("\n  {}: ", path))));
  return resolved;
}

const Verb& find_verb(const std::string& name) {
  const auto found = std::ranges::find(verbs(), name, &Verb::name);
  ensure(found != verbs().end(), "verb without a recipe: " + name);
  return *found;
}

std::string case_head(const Comm& comm, const std::string& verb, const std::string& case_path) {
  return fmt::format("# wingbeat {} ({}): {} {} on {}\n\n", version(), git_commit(), verb, case_path,
                     counted(comm.size(), "rank"));
}

int run_case(const Comm& comm, const CommandLine& command) {
  FailureAgreement agreement(comm);
  Timer timer;
  Result result{.command = command.verb, .ranks = comm.size(), .version = std::string(version())};
  Failure failure;
  // A folder that another run holds is left as it is.
  std::optional<FolderLock> lock;
  bool holds_folder = false;
  try {
    if (!command.dry_run) {
      on_root(comm, [&] { lock.emplace(command.output, "wingbeat " + command.verb); });
      holds_folder = true;
    }
    return execute(comm, command, result, timer);
  } catch (const InputError& error) {
    failure = {exit_bad_input, error.what()};
  } catch (const std::bad_alloc&) {
    failure = {exit_internal, "out of memory; use more ranks or a smaller case"};
  } catch (const std::exception& error) {
    failure = {exit_internal, fmt::format("internal error, please report it: {}", error.what())};
  }

  constexpr double patience_seconds = 5.0;
  if (agreement.all_failed(patience_seconds)) {
    if (comm.is_root()) {
      fmt::print(stderr, "wingbeat: {}\n", failure.message);
      if (holds_folder) write_failure(command, result, timer, failure.message);
    }
    // Ranks may have failed in different ways: the gravest decides.
    return static_cast<int>(comm.max(failure.exit_code));
  }
  const std::string message = fmt::format("rank {}: {}", comm.rank(), failure.message);
  fmt::print(stderr, "wingbeat: {}\n", message);
  if (holds_folder) {
    write_failure(command, result, timer, message);
    std::error_code ignored;
    fs::remove(FolderLock::file_in(command.output), ignored);  // rank 0 will not come to it
  }
  agreement.abort(failure.exit_code);
}

}  // namespace wingbeat
