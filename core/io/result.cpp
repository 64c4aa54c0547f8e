#include "core/io/result.hpp"

#include "core/io/file.hpp"

namespace wingbeat {

std::string Result::text() const {
  nlohmann::ordered_json json = {
      {"command", command}, {"status", status}, {"message", message}, {"ranks", ranks}, {"version", version}};
  json["wall_seconds"] = nlohmann::ordered_json::object();
  for (const auto& [part, seconds] : wall_seconds) json["wall_seconds"][part] = seconds;
  json.update(findings);
  // A path that is not UTF-8 must not stop the report of the failure it caused.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void Result::write(const std::filesystem::path& path) const { write_file(path, text()); }

}  // namespace wingbeat
