#include "core/io/setting_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace wingbeat {

namespace {

std::string default_column(const Setting& key) {
  if (key.info.required) return "required";
  return key.default_text.empty() ? "unset" : key.default_text;
}

std::string allowed_column(const Setting& key) {
  const std::string allowed = key.allowed_text();
  return allowed.empty() ? "any" : allowed;
}

// "case.toml:7" of "wings/case.toml:7": the head of the file names the whole path.
std::string short_source(const std::string& source) { return source.substr(source.rfind('/') + 1); }

// A bar would end the cell of a Markdown table.
std::string markdown_cell(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += c;
  }
  return cell;
}

}  // namespace

std::string resolved_case(const SettingRegistry& settings) {
  std::string text;
  for (const auto& section : settings.sections()) {
    std::string lines;
    for (const auto& key : section.keys()) {
      const bool is_given = !key.source.empty();
      if (key.info.required && !is_given) continue;
      const std::string value = key.value_text();
      if (value.empty()) continue;
      lines += fmt::format("{:<40} # {}\n", key.name + " = " + value,
                           is_given ? short_source(key.source) : "default");
    }
    if (!lines.empty()) text += fmt::format("{}[{}]\n{}", text.empty() ? "" : "\n", section.name(), lines);
  }
  return text;
}

std::string reference_table(const SettingRegistry& settings) {
  std::size_t name_width = 0, default_width = 0, allowed_width = 0;
  for (const auto& section : settings.sections())
    for (const auto& key : section.keys()) {
      name_width = std::max(name_width, key.name.size());
      default_width = std::max(default_width, default_column(key).size());
      allowed_width = std::max(allowed_width, allowed_column(key).size());
    }
  std::string text;
  for (const auto& section : settings.sections()) {
    text += fmt::format("{}[{}]  {}\n", text.empty() ? "" : "\n", section.name(), section.help());
    for (const auto& key : section.keys())
      text += fmt::format("  {:<{}}  {:<15}  {:<{}}  {:<{}}  {}{}\n", key.name, name_width, key.type_text(),
                          default_column(key), default_width, allowed_column(key), allowed_width,
                          key.info.help, key.info.unit.empty() ? "" : " [" + key.info.unit + "]");
  }
  return text;
}

std::string reference_markdown(const SettingRegistry& settings) {
  std::string text;
  for (const auto& section : settings.sections()) {
    text += fmt::format("{}## [{}]\n\n{}\n\n", text.empty() ? "" : "\n", section.name(), section.help());
    text += "| key | type | default | allowed | unit | meaning |\n|---|---|---|---|---|---|\n";
    for (const auto& key : section.keys())
      text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, key.type_text(),
                          markdown_cell(default_column(key)), markdown_cell(allowed_column(key)),
                          key.info.unit.empty() ? "-" : key.info.unit, markdown_cell(key.info.help));
  }
  return text;
}

}  // namespace wingbeat
