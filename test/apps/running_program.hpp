#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace wingbeat {

// A program at work under mpirun in a folder, to be sent signals. Killed, with its ranks, when it goes out of
// scope.
class RunningProgram {
 public:
  RunningProgram(const std::filesystem::path& folder, const std::string& program,
                 const std::vector<std::string>& arguments, int ranks);
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  // What it has printed so far, on both streams.
  std::string output() const;
  // False where it ended, or a minute passed, without printing that, or without `then` after it.
  bool has_printed(const std::string& awaited, const std::string& then = "") const;
  // False where it ended, or a minute passed, without that text in the file.
  bool has_written(const std::filesystem::path& file, const std::string& text) const;

  void signal_launcher(int signal) const;
  void signal_ranks(int signal) const;
  // As kill -9 to all of it at once.
  void kill();
  // Its exit code; -1 where a signal ended mpirun.
  int finish();

 private:
  template <class Condition>
  bool comes_true(const Condition& condition) const;
  bool is_rank(pid_t process) const;
  std::vector<pid_t> ranks() const;
  bool is_running() const;

  std::filesystem::path folder_;
  std::string program_;
  pid_t launcher_ = -1;
};

}  // namespace wingbeat
