#include "core/io/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/io/error.hpp"
#include "core/io/file.hpp"

namespace wingbeat {

namespace fs = std::filesystem;

namespace {

constexpr int most_attempts = 100;  // while other runs take and leave the lock

// Who holds a lock, as its file says.
struct Holder {
  std::string host;
  long process = 0;
  std::string started;  // in the system's clock ticks: a process number alone may be used again
  std::string since;
  std::string run;
};

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

// Field 22 of /proc/N/stat, counted behind the name, which may hold blanks; empty where there is none, or
// where the process is dead and only waits for its parent to ask after it (field 3).
std::string start_of(long process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(file, text);
  std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
  std::string state, field;
  fields >> state;
  for (int i = 4; i <= 22 && fields >> field; ++i) {
  }
  return fields && state != "Z" ? field : "";
}

std::string text_of(const Holder& holder) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n", holder.host, holder.process, holder.started, holder.since,
                     holder.run);
}

std::optional<Holder> read_holder(int descriptor) {
  std::array<char, 4096> buffer{};
  const ssize_t length = ::pread(descriptor, buffer.data(), buffer.size(), 0);
  std::istringstream lines(std::string(buffer.data(), length > 0 ? static_cast<std::size_t>(length) : 0));
  Holder holder;
  std::string process;
  const bool is_whole = std::getline(lines, holder.host) && std::getline(lines, process) &&
                        std::getline(lines, holder.started) && std::getline(lines, holder.since) &&
                        std::getline(lines, holder.run);
  if (!is_whole) return std::nullopt;
  holder.process = std::strtol(process.c_str(), nullptr, 10);
  return holder;
}

bool is_gone(const Holder& holder, const fs::path& file) {
  if (holder.host == host_name()) return start_of(holder.process) != holder.started;
  return since_heartbeat(file) > FolderLock::patience;
}

[[noreturn]] void refuse(const fs::path& file, const std::optional<Holder>& holder) {
  const std::string folder = file.parent_path().string();
  if (!holder)
    throw InputError(
        fmt::format("{}: another run begins in this folder, or was killed as it began; give another "
                    "--output, or remove {}",
                    folder, file.string()));
  throw InputError(fmt::format(
      "{}: in use by \"{}\" since {} (host {}, process {}); wait for it, give another --output, or, "
      "if it runs no more, remove {}{}",
      folder, holder->run, holder->since, holder->host, holder->process, file.string(),
      holder->host == host_name()
          ? ""
          : fmt::format(" or wait until that has been silent for {} minutes", FolderLock::patience.count())));
}

[[noreturn]] void fail(const fs::path& file, int error) {
  throw InputError(fmt::format("{}: cannot write the file: {}", file.string(), std::strerror(error)));
}

// Whether the name still leads to the open file: it may have been removed by the run that held it.
bool is_current(int descriptor, const fs::path& file) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

// A file that is closed unless it is released.
struct OpenFile {
  int descriptor;
  ~OpenFile() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

// One attempt: the descriptor of the lock, held; nothing where it went away meanwhile.
std::optional<int> try_to_hold(const fs::path& file) {
  OpenFile opened{::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644)};
  const bool created = opened.descriptor >= 0;
  if (!created) {
    if (errno != EEXIST) fail(file, errno);
    opened.descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
    if (opened.descriptor < 0 && errno != ENOENT) fail(file, errno);
    if (opened.descriptor < 0) return std::nullopt;
  }
  // The kernel ends such a lock with its process. Where the file system has none, creation alone decides.
  const bool held = ::flock(opened.descriptor, LOCK_EX | LOCK_NB) == 0;
  const bool has_flock = held || errno == EWOULDBLOCK;
  const auto holder = read_holder(opened.descriptor);
  if (has_flock && !held) refuse(file, holder);
  if (!is_current(opened.descriptor, file)) return std::nullopt;
  const bool is_free = created || (holder ? is_gone(*holder, file) : held);
  if (!is_free) refuse(file, holder);
  return std::exchange(opened.descriptor, -1);
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const std::string& run, std::chrono::milliseconds interval)
    : file_(file_in(folder)) {
  create_folder(folder);
  for (int i = 0; i < most_attempts && descriptor_ < 0; ++i) descriptor_ = try_to_hold(file_).value_or(-1);
  if (descriptor_ < 0) refuse(file_, std::nullopt);
  const std::string text =
      text_of({host_name(), ::getpid(), start_of(::getpid()),
               fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr))), run});
  const bool written = ::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, text.data(), text.size(),
                                                                    0) == static_cast<ssize_t>(text.size());
  if (written) {
    try {
      heartbeat_.emplace(descriptor_, interval);
    } catch (const std::system_error&) {  // no thread to be had: at worst another host takes it for dead
    }
    return;
  }
  const int error = errno;
  ::unlink(file_.c_str());
  ::close(descriptor_);
  fail(file_, error);
}

FolderLock::~FolderLock() {
  heartbeat_.reset();
  if (is_current(descriptor_, file_)) ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace wingbeat
