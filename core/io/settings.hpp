#pragma once

#include <array>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace wingbeat {

// Interval of allowed numbers.
struct Bounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  bool contains(double value) const;
  bool is_limited() const;
  std::string text() const;  // "0.05 to 3", "> 0", ...
};

inline Bounds between(double lower, double upper) { return {.lower = lower, .upper = upper}; }
inline Bounds at_least(double lower) { return {.lower = lower}; }
inline Bounds above(double lower) { return {.lower = lower, .lower_open = true}; }
inline Bounds open_interval(double lower, double upper) {
  return {.lower = lower, .upper = upper, .lower_open = true, .upper_open = true};
}

// What a key names on disk: paths are taken relative to the case file and made absolute.
enum class PathRule { none, file, file_or_name };

// Everything a reader of the case needs to know about a key.
struct KeyInfo {
  std::string help{};
  std::string unit{};                  // empty: dimensionless
  Bounds range{};                      // holds for every number of a list
  std::vector<std::string> allowed{};  // of a text; empty: any
  bool required = false;               // by the verbs that use the section
  PathRule path = PathRule::none;
  std::function<bool(std::string_view)> is_name{};  // with file_or_name: no file is looked for
};

// The member of a settings struct that a key fills. An optional member stays empty unless given.
using SettingTarget =
    std::variant<bool*, int*, double*, std::string*, std::vector<double>*, std::vector<std::string>*,
                 std::array<int, 2>*, std::array<double, 2>*, std::optional<int>*, std::optional<double>*,
                 std::optional<std::string>*, std::optional<std::array<double, 2>>*>;

// One key of one section, bound to the value it fills.
struct Setting {
  std::string name;
  SettingTarget target;
  KeyInfo info;
  std::string default_text;  // as TOML; empty where there is none
  std::string source;        // "case.toml:7" or "command line" once given; empty: the default holds

  std::string type_text() const;     // "number", "two integers", ...
  std::string value_text() const;    // the present value as TOML; empty for an empty optional
  std::string allowed_text() const;  // range, set of texts or kind of path; empty: anything
};

// A condition between keys, blamed on one of them.
struct SettingRule {
  std::string key;
  std::function<bool()> holds;
  std::string message;  // completes "mesh.file = ...: "
};

// One [section] of a case.
class SettingSection {
 public:
  SettingSection(std::string name, std::string help) : name_(std::move(name)), help_(std::move(help)) {}

  // Declares a key that fills `target`, whose present value is the default.
  void add(std::string name, SettingTarget target, KeyInfo info);
  // Declares a condition that is tested once all keys of the section have been read without fault.
  void add_rule(std::string key, std::function<bool()> holds, std::string message);

  const std::string& name() const { return name_; }
  const std::string& help() const { return help_; }
  std::vector<Setting>& keys() { return keys_; }
  const std::vector<Setting>& keys() const { return keys_; }
  const std::vector<SettingRule>& rules() const { return rules_; }
  Setting* find(std::string_view name);
  std::vector<std::string> key_names() const;

 private:
  std::string name_;
  std::string help_;
  std::vector<Setting> keys_;
  std::vector<SettingRule> rules_;
};

// The keys of a case, declared once: reading, checking, echo and documentation follow from it.
// A section's struct declares its keys in `void describe(SettingSection&)`, binding its own
// members; the registry must therefore not outlive the structs.
class SettingRegistry {
 public:
  template <class Struct>
  void add_section(std::string name, std::string help, Struct& settings) {
    settings.describe(sections_.emplace_back(std::move(name), std::move(help)));
  }

  std::deque<SettingSection>& sections() { return sections_; }
  const std::deque<SettingSection>& sections() const { return sections_; }
  SettingSection* find(std::string_view section);
  std::vector<std::string> section_names() const;

 private:
  std::deque<SettingSection> sections_;
};

// A number as TOML text that reads back exactly; a float keeps a decimal point or an exponent.
std::string toml_text(double value);
std::string toml_text(const std::string& value);  // quoted and escaped

}  // namespace wingbeat
