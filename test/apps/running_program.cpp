#include "test/apps/running_program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

namespace wingbeat {

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void start(const fs::path& folder, std::vector<std::string> words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int file = ::open((folder / ".running").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int none = ::open("/dev/null", O_RDONLY);
  if (file < 0 || none < 0 || ::chdir(folder.c_str()) != 0) ::_exit(99);
  ::dup2(none, 0);
  ::dup2(file, 1);
  ::dup2(file, 2);
  ::execvp(pointers[0], pointers.data());
  ::_exit(98);
}

}  // namespace

RunningProgram::RunningProgram(const fs::path& folder, const std::string& program,
                               const std::vector<std::string>& arguments, int ranks)
    : folder_(folder), program_(program) {
  fs::remove(folder / ".running");
  std::vector<std::string> words{WINGBEAT_MPIEXEC, "-n", std::to_string(ranks), program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  launcher_ = ::fork();
  if (launcher_ == 0) start(folder, std::move(words));
}

RunningProgram::~RunningProgram() {
  if (launcher_ > 0) kill();
}

std::string RunningProgram::output() const { return text_of(folder_ / ".running"); }

bool RunningProgram::is_running() const {
  siginfo_t ended{};
  ended.si_pid = 0;
  return ::waitid(P_PID, static_cast<id_t>(launcher_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         ended.si_pid == 0;
}

template <class Condition>
bool RunningProgram::comes_true(const Condition& condition) const {
  for (int i = 0; i < 30000; ++i) {
    const bool was_running = is_running();
    if (condition()) return true;
    if (!was_running) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

bool RunningProgram::has_printed(const std::string& awaited, const std::string& then) const {
  return comes_true([&] {
    const std::string text = output();
    const auto first = text.find(awaited);
    return first != std::string::npos && text.find(then, first) != std::string::npos;
  });
}

bool RunningProgram::has_written(const fs::path& file, const std::string& text) const {
  return comes_true([&] { return text_of(folder_ / file).find(text) != std::string::npos; });
}

bool RunningProgram::is_rank(pid_t process) const {
  std::error_code gone;
  return fs::read_symlink(fs::path("/proc") / std::to_string(process) / "exe", gone) == fs::path(program_);
}

// On one machine they are children of mpirun.
std::vector<pid_t> RunningProgram::ranks() const {
  const std::string task = std::to_string(launcher_);
  std::ifstream children(fs::path("/proc") / task / "task" / task / "children");
  std::vector<pid_t> found;
  for (pid_t child = 0; children >> child;)
    if (is_rank(child)) found.push_back(child);
  return found;
}

void RunningProgram::signal_launcher(int signal) const { ::kill(launcher_, signal); }

void RunningProgram::signal_ranks(int signal) const {
  for (const pid_t rank : ranks()) ::kill(rank, signal);
}

void RunningProgram::kill() {
  const std::vector<pid_t> all = ranks();
  ::kill(launcher_, SIGSTOP);  // lest it start or end others
  for (const pid_t rank : all) ::kill(rank, SIGKILL);
  ::kill(launcher_, SIGKILL);
  finish();
  // A killed process holds its files until it has ended.
  for (int i = 0; i < 5000 && std::ranges::any_of(all, [&](pid_t rank) { return is_rank(rank); }); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

int RunningProgram::finish() {
  int status = 0;
  ::waitpid(launcher_, &status, 0);
  launcher_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace wingbeat
