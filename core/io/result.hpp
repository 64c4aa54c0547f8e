#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace wingbeat {

// What a run found, as scripts read it from result.json. A verb puts its findings into
// `findings` under the names of the contract:
//   result.findings["flutter"] = {{"reduced_velocity", v}, {"frequency_ratio", omega}};
// Numbers are written so that they read back exactly; one that is not finite becomes null.
struct Result {
  std::string command;
  std::string status = "error";  // converged, stalled, iteration-limit, diverged, interrupted, error
  std::string message{};
  int ranks = 1;
  std::string version{};
  std::vector<std::pair<std::string, double>> wall_seconds{};  // part of the program, seconds
  nlohmann::ordered_json findings = nlohmann::ordered_json::object();

  std::string text() const;
  // Replaces the file in one step. Throws InputError when it cannot be written.
  void write(const std::filesystem::path& path) const;
};

}  // namespace wingbeat
