#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace wingbeat {

// Reads the whole file. Throws InputError with the system's reason.
std::string read_file(const std::filesystem::path& path);

// Replaces the file in one step: readers see the old text or the new one, never a part.
// Creates missing parent folders. Throws InputError with the system's reason.
void write_file(const std::filesystem::path& path, std::string_view text);

// Creates the folder and those above it that are missing. Throws InputError with the system's reason.
void create_folder(const std::filesystem::path& folder);

// A file under construction: write to temporary(), then commit() moves it to its name in one
// step; without commit() it is removed. For libraries that write files themselves.
class AtomicFile {
 public:
  // Creates missing parent folders. Throws InputError with the system's reason.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  void commit();  // throws InputError when the file cannot be moved
  // The same for what a lost machine must not take along: all of it is on the disk before it gets its name,
  // and the file that had this name stays as `previous`. At every moment the name stands for a whole file.
  void commit_keeping(const std::filesystem::path& previous);

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
};

// Removes from a folder what an AtomicFile left that never came to its commit(): its process was killed.
void remove_unfinished(const std::filesystem::path& folder);

}  // namespace wingbeat
