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

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
};

}  // namespace wingbeat
