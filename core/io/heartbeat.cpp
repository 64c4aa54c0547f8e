#include "core/io/heartbeat.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <string>

namespace wingbeat {

Heartbeat::Heartbeat(int descriptor, std::chrono::milliseconds interval)
    : thread_([descriptor, interval](const std::stop_token& stop) {
        sigset_t all;  // signals are the program's own
        sigfillset(&all);
        ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
        std::mutex mutex;
        std::condition_variable_any ending;
        std::unique_lock lock(mutex);
        while (!stop.stop_requested()) {
          ending.wait_for(lock, stop, interval, [] { return false; });
          ::futimens(descriptor, nullptr);
        }
      }) {}

std::chrono::seconds since_heartbeat(const std::filesystem::path& file) {
  std::string probe = file.string() + ".now-XXXXXX";
  const int descriptor = ::mkstemp(probe.data());
  if (descriptor < 0) return {};
  struct stat now {
  }, then{};
  const bool is_known = ::fstat(descriptor, &now) == 0 && ::stat(file.c_str(), &then) == 0;
  ::close(descriptor);
  ::unlink(probe.c_str());
  return std::chrono::seconds(is_known ? std::max<long>(0, now.st_mtime - then.st_mtime) : 0);
}

}  // namespace wingbeat
