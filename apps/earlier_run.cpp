#include "apps/earlier_run.hpp"

#include <nlohmann/json.hpp>

#include "core/io/file.hpp"

namespace wingbeat {

namespace fs = std::filesystem;

namespace {

bool has_failed(const fs::path& result) {
  if (!fs::exists(result)) return false;  // a killed run has none
  const auto found = nlohmann::json::parse(read_file(result), nullptr, false);
  return !found.is_object() || found.value("status", "error") == "error";
}

}  // namespace

void set_aside_earlier_run(const fs::path& folder) {
  const fs::path result = folder / "result.json";
  if (!fs::exists(folder / "case.toml") || has_failed(result)) {
    std::error_code ignored;  // what cannot be removed cannot be written either, which is told then
    fs::remove(result, ignored);
    return;
  }
  const fs::path earlier = folder / "earlier";
  create_folder(earlier);
  for (const char* name : {"case.toml", "log.txt", "result.json"}) {
    std::error_code ignored;
    fs::remove(earlier / name, ignored);
    fs::rename(folder / name, earlier / name, ignored);
  }
}

}  // namespace wingbeat
