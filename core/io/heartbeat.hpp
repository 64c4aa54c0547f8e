#pragma once

#include <chrono>
#include <filesystem>
#include <thread>

namespace wingbeat {

// Renews the time of an open file at every interval, from a thread of its own, so that other hosts see that
// whoever holds it is alive. The descriptor outlives it.
class Heartbeat {
 public:
  Heartbeat(int descriptor, std::chrono::milliseconds interval);

 private:
  std::jthread thread_;
};

// How long ago a file was renewed, by the clock of its own file system, which hosts share. Zero where that
// cannot be told.
std::chrono::seconds since_heartbeat(const std::filesystem::path& file);

}  // namespace wingbeat
