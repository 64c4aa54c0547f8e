#include "apps/earlier_run.hpp"

#include <nlohmann/json.hpp>

#include "core/io/file.hpp"

namespace wingbeat {

namespace fs = std::filesystem;

std::string status_in(const fs::path& result) {
  const auto found = nlohmann::json::parse(read_file(result), nullptr, false);
  const bool tells = found.is_object() && found.contains("status") && found["status"].is_string();
  return tells ? found["status"].get<std::string>() : "";
}

namespace {

bool has_failed(const fs::path& result) {
  if (!fs::exists(result)) return false;  // a killed run has none
  const std::string status = status_in(result);
  return status.empty() || status == "error";
}

}  // namespace

void set_aside_earlier_run(const fs::path& folder) {
  const fs::path result = folder / "result.json", earlier = folder / "earlier";
  std::error_code ignored;  // what cannot be removed cannot be written either, which is told then
  if (fs::exists(folder / "case.toml") && !has_failed(result)) {
    create_folder(earlier);
    // Copied, since the case may be what this run is to read.
    for (const char* name : {"case.toml", "log.txt", "result.json"}) {
      fs::remove(earlier / name, ignored);
      fs::copy_file(folder / name, earlier / name, ignored);
    }
  }
  fs::remove(result, ignored);
}

}  // namespace wingbeat
