#include "core/io/file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/io/error.hpp"

namespace wingbeat {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  const auto refuse = [&](const char* reason) {
    throw InputError(fmt::format("{}: cannot read the file: {}", path.string(), reason));
  };
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) refuse("it is a folder");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::string text;
  if (stream) text.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream) refuse(errno != 0 ? std::strerror(errno) : "input failed");
  return text;
}

void write_file(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  errno = 0;
  std::ofstream stream(file.temporary(), std::ios::binary | std::ios::trunc);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (!stream)
    throw InputError(fmt::format("{}: cannot write the file: {}", path.string(), std::strerror(errno)));
  file.commit();
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
  // The process number keeps two runs that share a folder apart.
  temporary_ = path_.string() + fmt::format(".part-{}", ::getpid());
  std::error_code error;
  if (path_.has_parent_path()) fs::create_directories(path_.parent_path(), error);
  if (error)
    throw InputError(
        fmt::format("{}: cannot create the folder: {}", path_.parent_path().string(), error.message()));
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) throw InputError(fmt::format("{}: cannot write the file: {}", path_.string(), error.message()));
}

}  // namespace wingbeat
