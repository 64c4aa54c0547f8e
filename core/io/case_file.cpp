#include "core/io/case_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/io/error.hpp"
#include "core/io/file.hpp"
#include "core/io/nearest_name.hpp"
#include "core/io/toml_value.hpp"

namespace wingbeat {

namespace fs = std::filesystem;

namespace {

// A value and where it was written.
struct Entry {
  std::string place;       // "case.toml:7" or "command line"
  const toml::node* node;  // owned by the text's table or by an override's
  bool from_command_line = false;
  std::size_t order = 0;  // as written: lines of the text, then overrides
};

using KeyPath = std::pair<std::string, std::string>;  // section, key

std::string place_of(const std::string& file, const toml::source_region& region) {
  return fmt::format("{}:{}", file, region.begin.line);
}

std::string suggestion(std::string_view wrong, std::span<const std::string> names, std::string_view form) {
  const std::string nearest = nearest_name(wrong, names);
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", fmt::format(fmt::runtime(form), nearest));
}

}  // namespace

struct CaseFile::Data {
  std::string name;
  toml::table text;
  std::vector<std::unique_ptr<toml::table>> overrides;  // each owns the value of one override
  std::map<KeyPath, Entry> entries;
  std::vector<std::string> early_faults;                      // found before the keys are matched
  std::vector<std::pair<std::string, std::string>> sections;  // name and place, as written

  void collect_text();
  void collect_section(const std::string& section, const toml::table& table);
};

void CaseFile::Data::collect_text() {
  for (const auto& [key, node] : text) {
    const std::string section(key.str());
    const std::string place = place_of(name, key.source());
    if (const toml::table* table = node.as_table()) {
      sections.emplace_back(section, place);
      collect_section(section, *table);
    } else {
      early_faults.push_back(fmt::format(
          "{}: {} = {}: a key outside a section; write it under its section, such as [flow], then mach = 0.8",
          place, section, toml_node_text(node)));
    }
  }
}

void CaseFile::Data::collect_section(const std::string& section, const toml::table& table) {
  for (const auto& [key, node] : table)
    entries[{section, std::string(key.str())}] = {place_of(name, key.source()), &node, false,
                                                  key.source().begin.line};
}

CaseFile::CaseFile(std::string_view text, std::string name) : data_(std::make_unique<Data>()) {
  data_->name = std::move(name);
  try {
    data_->text = toml::parse(text, std::string_view(data_->name));
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    throw InputError(fmt::format("{}:{}:{}: not valid TOML: {}", data_->name, begin.line, begin.column,
                                 error.description()));
  }
  data_->collect_text();
}

CaseFile::~CaseFile() = default;
CaseFile::CaseFile(CaseFile&&) noexcept = default;
CaseFile& CaseFile::operator=(CaseFile&&) noexcept = default;

void CaseFile::add_override(const std::string& assignment, const std::string& place) {
  const auto equals = assignment.find('=');
  const auto dot = assignment.find('.');
  const bool well_formed = equals != std::string::npos && dot != std::string::npos && dot > 0 &&
                           dot + 1 < equals && assignment.find('.', dot + 1) >= equals;
  if (!well_formed) {
    data_->early_faults.push_back(
        fmt::format("{}: {}: expected section.key=value, such as flow.mach=0.8", place, assignment));
    return;
  }
  const std::string section = assignment.substr(0, dot);
  const std::string key = assignment.substr(dot + 1, equals - dot - 1);
  const std::string value = assignment.substr(equals + 1);
  auto table = std::make_unique<toml::table>();
  try {
    *table = toml::parse("value = " + value);
  } catch (const toml::parse_error&) {
    table->clear();
  }
  // One value alone: "1\nx = 2" is a text, not two keys.
  if (table->size() != 1) *table = toml::table{{"value", value}};
  // Any line of a text comes before any override.
  constexpr std::size_t after_text = std::numeric_limits<toml::source_index>::max();
  data_->entries[{section, key}] = {place, table->get("value"), true, after_text + data_->overrides.size()};
  if (std::ranges::find(data_->sections, section, &std::pair<std::string, std::string>::first) ==
      data_->sections.end())
    data_->sections.emplace_back(section, place);
  data_->overrides.push_back(std::move(table));
}

namespace {

// Matches entries with settings and gathers the faults.
class Matcher {
 public:
  Matcher(SettingRegistry& settings, std::string case_name)
      : settings_(settings), folder_(fs::path(case_name).parent_path()), case_name_(std::move(case_name)) {}

  void check_section(const std::string& section, const std::string& place);
  void read(const KeyPath& path, const Entry& entry);
  void check_required(const SettingSection& section, const std::string& reader);
  void check_rules(const SettingSection& section);

  std::vector<std::string> faults;

 private:
  void blame(const KeyPath& path, const Entry& entry, const std::string& problem);
  void report_unknown(const KeyPath& path, const Entry& entry, const SettingSection& section);
  void resolve_path(const KeyPath& path, const Entry& entry, Setting& setting);

  SettingRegistry& settings_;
  fs::path folder_;
  std::string case_name_;
  std::set<KeyPath> blamed_;
};

void Matcher::blame(const KeyPath& path, const Entry& entry, const std::string& problem) {
  faults.push_back(fmt::format("{}: {}.{}{}{}: {}", entry.place, path.first, path.second,
                               entry.from_command_line ? "=" : " = ", toml_node_text(*entry.node), problem));
  blamed_.insert(path);
}

void Matcher::check_section(const std::string& section, const std::string& place) {
  if (settings_.find(section)) return;
  const auto names = settings_.section_names();
  faults.push_back(fmt::format("{}: [{}]: unknown section{}; sections: {}", place, section,
                               suggestion(section, names, "[{}]"), fmt::join(names, ", ")));
}

void Matcher::report_unknown(const KeyPath& path, const Entry& entry, const SettingSection& section) {
  std::string hint;
  for (const auto& other : settings_.sections())
    if (settings_.find(other.name())->find(path.second))
      hint = fmt::format("; did you mean {}.{}?", other.name(), path.second);
  const auto names = section.key_names();
  if (hint.empty()) hint = suggestion(path.second, names, section.name() + ".{}");
  blame(path, entry,
        fmt::format("unknown key{}; keys of [{}]: {}", hint, section.name(), fmt::join(names, ", ")));
}

void Matcher::read(const KeyPath& path, const Entry& entry) {
  SettingSection* section = settings_.find(path.first);
  if (!section) return;  // its section has been reported
  Setting* setting = section->find(path.second);
  if (!setting) return report_unknown(path, entry, *section);
  if (const auto problem = read_toml_value(*entry.node, *setting)) return blame(path, entry, *problem);
  setting->source = entry.place;
  if (setting->info.path != PathRule::none) resolve_path(path, entry, *setting);
}

void Matcher::resolve_path(const KeyPath& path, const Entry& entry, Setting& setting) {
  auto* plain = std::get_if<std::string*>(&setting.target);
  auto* optional = std::get_if<std::optional<std::string>*>(&setting.target);
  ensure(plain || optional, "a path must be a text: " + path.second);
  std::string& value = plain ? **plain : (*optional)->value();
  if (setting.info.is_name && setting.info.is_name(value)) return;
  std::error_code ignored;
  fs::path file = folder_ / value;
  if (entry.from_command_line && fs::exists(value, ignored)) file = value;
  if (fs::is_regular_file(file, ignored)) {
    value = fs::absolute(file).lexically_normal().string();
    return;
  }
  const bool is_folder = fs::is_directory(file, ignored);
  blame(path, entry,
        fmt::format("{}{} {}; allowed: {}{}", setting.info.is_name ? "not a known name, and " : "",
                    is_folder ? "a folder, not a file:" : "no such file:",
                    fs::absolute(file).lexically_normal().string(), setting.allowed_text(),
                    "; paths are relative to the case file"));
}

void Matcher::check_required(const SettingSection& section, const std::string& reader) {
  for (const auto& key : section.keys()) {
    if (!key.info.required || !key.source.empty()) continue;
    if (blamed_.contains({section.name(), key.name})) continue;
    const std::string allowed = key.allowed_text();
    faults.push_back(fmt::format("{}: {}.{}: missing; {} needs it: {} ({}{}{})", case_name_, section.name(),
                                 key.name, reader, key.info.help, key.type_text(),
                                 allowed.empty() ? "" : ", ", allowed));
    blamed_.insert({section.name(), key.name});
  }
}

void Matcher::check_rules(const SettingSection& section) {
  // A rule between keys means nothing while one of them is wrong.
  if (std::ranges::find(blamed_, section.name(), &KeyPath::first) != blamed_.end()) return;
  for (const auto& rule : section.rules()) {
    if (rule.holds()) continue;
    const Setting& key = *settings_.find(section.name())->find(rule.key);
    const std::string place = key.source.empty() ? case_name_ : key.source;
    faults.push_back(fmt::format("{}: {}.{} = {}: {}", place, section.name(), key.name,
                                 key.value_text().empty() ? "(not set)" : key.value_text(), rule.message));
  }
}

}  // namespace

void CaseFile::apply(SettingRegistry& settings, std::span<const std::string> used_sections,
                     const std::string& reader) const {
  apply(
      settings, [&] { return std::vector<std::string>(used_sections.begin(), used_sections.end()); }, reader);
}

void CaseFile::apply(SettingRegistry& settings,
                     const std::function<std::vector<std::string>()>& used_sections,
                     const std::string& reader) const {
  Matcher matcher(settings, data_->name);
  matcher.faults = data_->early_faults;
  for (const auto& [section, place] : data_->sections) matcher.check_section(section, place);
  std::vector<std::pair<KeyPath, Entry>> as_written(data_->entries.begin(), data_->entries.end());
  std::ranges::stable_sort(as_written, {}, [](const auto& item) { return item.second.order; });
  for (const auto& [path, entry] : as_written) matcher.read(path, entry);
  const std::vector<std::string> used_names = used_sections();
  for (const auto& section : settings.sections()) {
    const bool used = std::ranges::find(used_names, section.name()) != used_names.end();
    if (used) matcher.check_required(section, reader);
    if (used) matcher.check_rules(section);
  }
  const auto& faults = matcher.faults;
  if (faults.empty()) return;
  if (faults.size() == 1) throw InputError(faults.front());
  throw InputError(fmt::format("{} faults in the case:\n  {}", faults.size(), fmt::join(faults, "\n  ")));
}

std::string read_case_text(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    throw InputError(fmt::format("{}: a folder; name its case file, such as {}", path,
                                 (fs::path(path) / "case.toml").string()));
  return read_file(path);
}

}  // namespace wingbeat
