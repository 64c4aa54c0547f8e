#include "apps/plot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <string>
#include <vector>

#include "apps/version.hpp"
#include "core/io/error.hpp"

namespace wingbeat {

namespace fs = std::filesystem;

namespace {

// Runs a program found on PATH, without a shell. Returns its exit status, -1 if it cannot run.
int run_process(std::vector<std::string> arguments, bool is_quiet) {
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (is_quiet)
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), ::environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (failed || ::waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

// The script lies beside the build, where it was installed, or in the sources.
fs::path find_script() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  const std::array candidates{program / "../share/wingbeat/plots/plot.py",
                              program / "../../apps/plots/plot.py",
                              fs::path(source_folder()) / "apps/plots/plot.py"};
  for (const auto& candidate : candidates)
    if (fs::is_regular_file(candidate, ignored)) return candidate.lexically_normal();
  throw InputError(fmt::format("plot: the script plot.py is neither beside {} nor in {}", program.string(),
                               source_folder()));
}

// The first Python on PATH may be a private one that lacks the system's packages. One that reads solution
// files too (h5py) comes before one that only draws.
std::string find_python() {
  for (const std::string needed : {"import matplotlib, h5py", "import matplotlib"})
    for (const std::string python : {"python3", "/usr/bin/python3"})
      if (run_process({python, "-c", needed}, true) == 0) return python;
  throw InputError("plot: no Python with matplotlib; install it with: apt-get install python3-matplotlib");
}

}  // namespace

void plot_results(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw InputError(
        fmt::format("plot: {}: no such folder; name one that a verb has written", folder.string()));
  const fs::path script = find_script();
  const int status = run_process({find_python(), script.string(), folder.string()}, false);
  if (status != 0) throw InputError(fmt::format("plot: {} failed with status {}", script.string(), status));
}

}  // namespace wingbeat
