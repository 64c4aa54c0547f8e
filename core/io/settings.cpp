#include "core/io/settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

std::string text_of(bool value) { return value ? "true" : "false"; }
std::string text_of(int value) { return std::to_string(value); }
std::string text_of(double value) { return toml_text(value); }
std::string text_of(const std::string& value) { return toml_text(value); }

template <class List>
std::string list_text(const List& values) {
  std::vector<std::string> items;
  for (const auto& value : values) items.push_back(text_of(value));
  return fmt::format("[{}]", fmt::join(items, ", "));
}
template <class T>
std::string text_of(const std::vector<T>& values) {
  return list_text(values);
}
template <class T>
std::string text_of(const std::array<T, 2>& values) {
  return list_text(values);
}
template <class T>
std::string text_of(const std::optional<T>& value) {
  return value ? text_of(*value) : "";
}

// Overloads on a null pointer: the type alone decides.
std::string type_of(const bool*) { return "true or false"; }
std::string type_of(const int*) { return "integer"; }
std::string type_of(const double*) { return "number"; }
std::string type_of(const std::string*) { return "text"; }
std::string type_of(const std::vector<double>*) { return "list of numbers"; }
std::string type_of(const std::vector<std::string>*) { return "list of texts"; }
std::string type_of(const std::array<int, 2>*) { return "two integers"; }
std::string type_of(const std::array<double, 2>*) { return "two numbers"; }
template <class T>
std::string type_of(const std::optional<T>*) {
  return type_of(static_cast<const T*>(nullptr));
}

}  // namespace

bool Bounds::contains(double value) const {
  const bool above_lower = lower_open ? value > lower : value >= lower;
  const bool below_upper = upper_open ? value < upper : value <= upper;
  return above_lower && below_upper;
}

bool Bounds::is_limited() const { return std::max(lower, -upper) > -std::numeric_limits<double>::infinity(); }

std::string Bounds::text() const {
  const double infinity = std::numeric_limits<double>::infinity();
  if (!is_limited()) return "";
  if (upper == infinity) return fmt::format("{} {}", lower_open ? ">" : ">=", lower);
  if (lower == -infinity) return fmt::format("{} {}", upper_open ? "<" : "<=", upper);
  if (!lower_open && !upper_open) return fmt::format("{} to {}", lower, upper);
  return fmt::format("{} {}, {} {}", lower_open ? ">" : ">=", lower, upper_open ? "<" : "<=", upper);
}

std::string Setting::type_text() const {
  return std::visit([](auto* value) { return type_of(value); }, target);
}

std::string Setting::value_text() const {
  return std::visit([](auto* value) { return text_of(*value); }, target);
}

std::string Setting::allowed_text() const {
  if (!info.allowed.empty()) return fmt::format("\"{}\"", fmt::join(info.allowed, "\", \""));
  if (info.path == PathRule::file) return "an existing file";
  if (info.path == PathRule::file_or_name) return "a name or an existing file";
  return info.range.text();
}

void SettingSection::add(std::string name, SettingTarget target, KeyInfo info) {
  ensure(find(name) == nullptr, "key declared twice: " + name_ + "." + name);
  Setting setting{
      .name = std::move(name), .target = target, .info = std::move(info), .default_text = "", .source = ""};
  if (!setting.info.required) setting.default_text = setting.value_text();
  keys_.push_back(std::move(setting));
}

void SettingSection::add_rule(std::string key, std::function<bool()> holds, std::string message) {
  ensure(find(key) != nullptr, "rule about an undeclared key: " + name_ + "." + key);
  rules_.push_back({std::move(key), std::move(holds), std::move(message)});
}

Setting* SettingSection::find(std::string_view name) {
  const auto found = std::ranges::find(keys_, name, &Setting::name);
  return found == keys_.end() ? nullptr : &*found;
}

std::vector<std::string> SettingSection::key_names() const {
  std::vector<std::string> names;
  for (const auto& key : keys_) names.push_back(key.name);
  return names;
}

SettingSection* SettingRegistry::find(std::string_view section) {
  const auto found = std::ranges::find(sections_, section, &SettingSection::name);
  return found == sections_.end() ? nullptr : &*found;
}

std::vector<std::string> SettingRegistry::section_names() const {
  std::vector<std::string> names;
  for (const auto& section : sections_) names.push_back(section.name());
  return names;
}

std::string toml_text(double value) {
  std::string text = fmt::format("{}", value);
  const bool looks_integer = text.find_first_not_of("-0123456789") == std::string::npos;
  return looks_integer ? text + ".0" : text;
}

std::string toml_text(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      text += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      text += c;
    }
  }
  return text + "\"";
}

}  // namespace wingbeat
