#include "test/apps/fuzz.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "test/nightly.hpp"

namespace wingbeat {

namespace {

constexpr rlim_t most_bytes = 4UL << 30;
constexpr rlim_t processor_seconds = 10;
constexpr unsigned wall_seconds = 60;
constexpr int most_reports = 5;

// In the child, before the program: nothing here may allocate.
[[noreturn]] void become(const char* folder, const std::vector<char*>& words) {
  const rlimit memory{most_bytes, most_bytes}, no_core{0, 0};
  const rlimit time{processor_seconds, processor_seconds + 1};
  const bool ready = ::chdir(folder) == 0 && ::setrlimit(RLIMIT_AS, &memory) == 0 &&
                     ::setrlimit(RLIMIT_CORE, &no_core) == 0 && ::setrlimit(RLIMIT_CPU, &time) == 0;
  const int output = ::open("/dev/null", O_RDWR),
            errors = ::open(".errors", O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (ready && output >= 0 && errors >= 0) {
    ::dup2(output, STDIN_FILENO);
    ::dup2(output, STDOUT_FILENO);
    ::dup2(errors, STDERR_FILENO);
    ::alarm(wall_seconds);
    ::execv(words[0], words.data());
  }
  ::_exit(99);
}

}  // namespace

bool Fuzz::End::hangs() const { return signal == SIGALRM || signal == SIGXCPU; }

Fuzz::End Fuzz::end_of(const std::string& subfolder, const std::vector<std::string>& arguments) const {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), program_);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string folder = (folder_ / subfolder).string();
  const pid_t child = ::fork();
  if (child == 0) become(folder.c_str(), pointers);
  int status = 0;
  ::waitpid(child, &status, 0);
  End end;
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end.errors = read(subfolder + "/.errors");
  return end;
}

void Fuzz::attempt_all(unsigned first, int count, const Attempt& attempt) const {
  std::atomic<int> next = 0;
  std::mutex reporting;
  int wrong = 0;
  const auto work = [&](const std::string& subfolder) {
    for (int i = next++; i < count; i = next++) {
      const unsigned seed = first + static_cast<unsigned>(i);
      const std::string fault = attempt(seed, subfolder);
      if (fault.empty()) continue;
      const std::scoped_lock lock(reporting);
      if (++wrong <= most_reports) ADD_FAILURE() << "WINGBEAT_FUZZ_SEED=" << seed << ": " << fault;
    }
  };
  // More than processors: a start mostly waits.
  {
    const std::array<std::jthread, 4> workers{std::jthread(work, "a"), std::jthread(work, "b"),
                                              std::jthread(work, "c"), std::jthread(work, "d")};
  }
  EXPECT_EQ(wrong, 0) << "of " << count << " inputs";
}

unsigned Fuzz::first_seed(unsigned otherwise) {
  const char* seed = std::getenv("WINGBEAT_FUZZ_SEED");
  return seed ? static_cast<unsigned>(std::strtoul(seed, nullptr, 10)) : otherwise;
}

int Fuzz::attempts(int in_all, int nightly) {
  if (std::getenv("WINGBEAT_FUZZ_SEED")) return 1;
  return testing::is_nightly() ? nightly : in_all;
}

}  // namespace wingbeat
