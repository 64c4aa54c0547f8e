#include "core/io/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/io/error.hpp"

namespace wingbeat {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view unfinished = ".part-";

// Has the system write a file, or a folder's names, to the disk. False: it could not, errno says why.
bool flush(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool is_flushed = ::fsync(file) == 0;
  const int reason = errno;
  ::close(file);
  errno = reason;
  return is_flushed;
}

// A second name for a file that is about to be replaced. Where the file system has no links the file is
// moved.
void keep_as(const fs::path& path, const fs::path& kept) {
  const fs::path link = kept.string() + fmt::format("{}{}", unfinished, ::getpid());
  std::error_code error, ignored;
  fs::remove(link, ignored);
  fs::create_hard_link(path, link, error);
  fs::rename(error ? path : link, kept, ignored);
  fs::remove(link, ignored);  // renaming onto a name of the same file leaves it
}

}  // namespace

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

void create_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError(fmt::format("{}: cannot create the folder: {}", folder.string(), error.message()));
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
  // The process number keeps two runs that share a folder apart.
  temporary_ = path_.string() + fmt::format("{}{}", unfinished, ::getpid());
  if (path_.has_parent_path()) create_folder(path_.parent_path());
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

void AtomicFile::commit_keeping(const fs::path& previous) {
  if (!flush(temporary_))
    throw InputError(fmt::format("{}: cannot write the file: {}", path_.string(), std::strerror(errno)));
  if (fs::exists(path_)) keep_as(path_, previous);
  commit();
  // Some file systems cannot flush a folder; they have done what they can.
  flush(path_.has_parent_path() ? path_.parent_path() : fs::path("."));
}

void remove_unfinished(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    const auto at = name.rfind(unfinished);
    if (at == std::string::npos || at + unfinished.size() == name.size()) continue;
    const std::string number = name.substr(at + unfinished.size());
    if (std::ranges::all_of(number, [](unsigned char c) { return std::isdigit(c); })) {
      std::error_code stays;
      fs::remove(entry.path(), stays);
    }
  }
}

}  // namespace wingbeat
