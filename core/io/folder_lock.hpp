#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "core/io/heartbeat.hpp"

namespace wingbeat {

// A folder of results held by one run: the file `lock` in it says by which. Goes with the run, however that
// ends. One that a killed run of this host left is taken over, and one of another host once it has been
// silent for `patience`.
class FolderLock {
 public:
  static constexpr std::chrono::minutes heartbeat{1}, patience{10};

  // Creates missing folders. `run` says what runs, such as "wingbeat steady". Throws InputError that tells
  // who holds the folder, since when and what to do, or with the system's reason.
  FolderLock(const std::filesystem::path& folder, const std::string& run,
             std::chrono::milliseconds interval = heartbeat);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  static std::filesystem::path file_in(const std::filesystem::path& folder) { return folder / "lock"; }

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::optional<Heartbeat> heartbeat_;
};

}  // namespace wingbeat
