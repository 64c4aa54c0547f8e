#include "core/io/memory.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

namespace wingbeat {

namespace fs = std::filesystem;

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double kibibyte = 1024.0;

// The number behind `name` in a file of lines "name number".
std::optional<double> entry(const fs::path& file, const std::string& name) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    double value = 0.0;
    if (words >> word && word == name && words >> value) return value;
  }
  return std::nullopt;
}

// A file of one number; nothing where there is no such file, or where it says "max".
std::optional<double> number_in(const fs::path& file) {
  std::ifstream in(file);
  double value = 0.0;
  return in >> value ? std::optional(value) : std::nullopt;
}

double own_bytes(const std::string& name) {
  return kibibyte * entry("/proc/self/status", name + ":").value_or(0.0);
}

// What a control group has left; files that were read and can be dropped do not count as used.
double left_in_group(const fs::path& folder, const char* limit, const char* usage, const char* droppable) {
  const auto most = number_in(folder / limit), used = number_in(folder / usage);
  if (!most || !used) return unlimited;
  return std::max(0.0, *most - *used + entry(folder / "memory.stat", droppable).value_or(0.0));
}

// The tightest of a group and those above it; `top` alone where the group's own folder is not to be seen, as
// in a container.
template <class Left>
double least_along(const fs::path& top, fs::path group, const Left& left) {
  double least = left(top);
  for (group = group.relative_path(); !group.empty(); group = group.parent_path())
    least = std::min(least, left(top / group));
  return least;
}

}  // namespace

double resident_bytes() { return own_bytes("VmRSS"); }
double peak_resident_bytes() { return own_bytes("VmHWM"); }

void return_freed_memory() { ::malloc_trim(0); }

double available_bytes(const fs::path& root) {
  double least = unlimited;
  if (const auto available = entry(root / "proc/meminfo", "MemAvailable:")) least = kibibyte * *available;
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    // "0::/path" of version 2, "7:memory:/path" of version 1.
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path group = line.substr(second + 1);
    if (controllers.empty())
      least = std::min(least, least_along(root / "sys/fs/cgroup", group, [](const fs::path& folder) {
                         return left_in_group(folder, "memory.max", "memory.current", "inactive_file");
                       }));
    else if (("," + controllers + ",").find(",memory,") != std::string::npos)
      least = std::min(least, least_along(root / "sys/fs/cgroup/memory", group, [](const fs::path& folder) {
                         return left_in_group(folder, "memory.limit_in_bytes", "memory.usage_in_bytes",
                                              "total_inactive_file");
                       }));
  }
  return least;
}

double allowed_bytes() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - own_bytes("VmSize"));
}

}  // namespace wingbeat
