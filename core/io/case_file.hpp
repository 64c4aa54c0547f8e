#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/io/settings.hpp"

namespace wingbeat {

// A case as written by its author: a TOML text and overrides of single keys. Values stay
// untyped until apply() matches them with declared settings.
class CaseFile {
 public:
  // Parses `text`; `name` is its path as the user gave it, for messages and as the origin of
  // relative paths. Throws InputError naming line and column of a TOML syntax error.
  CaseFile(std::string_view text, std::string name);
  ~CaseFile();
  CaseFile(CaseFile&&) noexcept;
  CaseFile& operator=(CaseFile&&) noexcept;

  // Adds a command-line override `section.key=value`, stronger than the text and than earlier
  // overrides. The value is read as TOML and, failing that, as a string. Faults are kept for apply() and
  // blamed on `place`.
  void add_override(const std::string& assignment, const std::string& place = "command line");

  // Fills the settings. `used_sections` are those whose required keys must be present; `reader`
  // names who needs them ("wingbeat flutter"). Relative paths become absolute: those of the text
  // are relative to its folder, those of the command line to the working directory or, where
  // there is no such file, to the folder of the text.
  // Throws one InputError that lists every fault of the case with its place, value, what is
  // allowed and the nearest valid name.
  void apply(SettingRegistry& settings, std::span<const std::string> used_sections,
             const std::string& reader) const;
  // The same where the values decide which sections are used: asked once all have been read.
  void apply(SettingRegistry& settings, const std::function<std::vector<std::string>()>& used_sections,
             const std::string& reader) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// Reads the whole file. Throws InputError saying why it cannot.
std::string read_case_text(const std::string& path);

}  // namespace wingbeat
