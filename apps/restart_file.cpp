#include "apps/restart_file.hpp"

#include <fmt/format.h>

#include <string>

#include "apps/on_root.hpp"
#include "core/io/error.hpp"
#include "core/mesh/cgns_mesh.hpp"
#include "core/mesh/solution_file.hpp"

namespace wingbeat {
namespace {

namespace fs = std::filesystem;

// Why a file is no solution to go on from; empty where it is one.
std::string fault_of(const fs::path& path) {
  try {
    std::visit([&]<int Dim>(const MultiblockMesh<Dim>& mesh) { read_solution<Dim>(path, mesh); },
               read_cgns(path));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

fs::path newest_whole(const fs::path& folder, Log& log) {
  const fs::path newest = folder / "solution.cgns";
  std::string faults;
  for (const fs::path& path : {newest, previous_solution(newest)}) {
    if (!fs::is_regular_file(path)) continue;
    const std::string fault = fault_of(path);
    if (fault.empty()) return path;
    log.warn(fault);
    faults += "\n  " + fault;
  }
  if (!faults.empty())
    throw InputError(fmt::format("command line: --restart {}: holds no solution that is whole:{}",
                                 folder.string(), faults));
  return {};
}

fs::path found(const CommandLine& command, const Verb& verb, Log& log) {
  const fs::path& given = *command.restart;
  if (fs::is_regular_file(given)) return given;
  if (!fs::is_directory(given))
    throw InputError(fmt::format("command line: --restart {}: no such file or folder", given.string()));
  fs::path path = unfinished_run(given, verb, log);
  if (!path.empty()) {
    log.line("goes on from {}", path.string());
    return path;
  }
  std::error_code ignored;
  if (!fs::equivalent(given, command.output, ignored))
    throw InputError(fmt::format("command line: --restart {}: the folder holds no {} to go on from",
                                 given.string(), verb.record.empty() ? "solution.cgns" : verb.record));
  log.line("{} holds nothing to go on from yet: begins anew", given.string());
  return {};
}

}  // namespace

fs::path unfinished_run(const fs::path& folder, const Verb& verb, Log& log) {
  if (verb.record.empty()) return newest_whole(folder, log);
  const fs::path record = folder / verb.record;
  return fs::is_regular_file(record) ? record : fs::path();
}

std::optional<fs::path> restart_file(const Comm& comm, const CommandLine& command, const Verb& verb,
                                     Log& log) {
  if (!command.restart) return std::nullopt;
  std::string path;
  on_root(comm, [&] { path = found(command, verb, log).string(); });
  path = comm.broadcast(path);
  if (path.empty()) return std::nullopt;
  return path;
}

}  // namespace wingbeat
