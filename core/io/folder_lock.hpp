#pragma once

#include <filesystem>
#include <string>

namespace wingbeat {

// A folder of results held by one run: the file `lock` in it says by which. Goes with the run, however that
// ends; one that a killed run of this host left is taken over.
class FolderLock {
 public:
  // Creates missing folders. `run` says what runs, such as "wingbeat steady". Throws InputError that tells
  // who holds the folder, since when and what to do, or with the system's reason.
  FolderLock(const std::filesystem::path& folder, const std::string& run);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  static std::filesystem::path file_in(const std::filesystem::path& folder) { return folder / "lock"; }

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace wingbeat
