#include "core/io/toml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <type_traits>

#include "core/io/nearest_name.hpp"

namespace wingbeat {

namespace {

using Problem = std::optional<std::string>;

std::string_view type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number with a fraction";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

Problem wrong_type(const toml::node& node, const Setting& setting) {
  const std::string allowed = setting.allowed_text();
  return fmt::format("expected {}{}{}, got {}", setting.type_text(), allowed.empty() ? "" : ": ", allowed,
                     type_name(node));
}

Problem out_of_range(const Setting& setting) {
  return fmt::format("out of range; allowed: {}{}{}", setting.info.range.text(),
                     setting.info.unit.empty() ? "" : " ", setting.info.unit);
}

Problem read(const toml::node& node, const Setting& setting, bool& value) {
  if (!node.is_boolean()) return wrong_type(node, setting);
  value = node.as_boolean()->get();
  return {};
}

Problem read(const toml::node& node, const Setting& setting, double& value) {
  if (!node.is_number()) return wrong_type(node, setting);
  const double number = *node.value<double>();
  if (!std::isfinite(number))
    return fmt::format("not a finite number{}{}", setting.info.range.is_limited() ? "; allowed: " : "",
                       setting.info.range.text());
  if (!setting.info.range.contains(number)) return out_of_range(setting);
  value = number;
  return {};
}

Problem read(const toml::node& node, const Setting& setting, int& value) {
  if (!node.is_integer()) return wrong_type(node, setting);
  const std::int64_t number = node.as_integer()->get();
  if (!std::in_range<int>(number) || !setting.info.range.contains(static_cast<double>(number)))
    return setting.info.range.is_limited() ? out_of_range(setting) : Problem("too large an integer");
  value = static_cast<int>(number);
  return {};
}

Problem read(const toml::node& node, const Setting& setting, std::string& value) {
  if (!node.is_string()) return wrong_type(node, setting);
  const std::string text = node.as_string()->get();
  const auto& allowed = setting.info.allowed;
  if (!allowed.empty() && std::ranges::find(allowed, text) == allowed.end()) {
    const std::string nearest = nearest_name(text, allowed);
    return fmt::format("allowed: {}{}", setting.allowed_text(),
                       nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest));
  }
  value = text;
  return {};
}

template <class List>
Problem read_items(const toml::array& array, const Setting& setting, List& values) {
  List items = values;
  for (std::size_t i = 0; i < array.size(); ++i)
    if (const auto problem = read(array[i], setting, items[i]))
      return fmt::format("entry {}: {}", i + 1, *problem);
  values = items;
  return {};
}

template <class T>
Problem read(const toml::node& node, const Setting& setting, std::array<T, 2>& values) {
  const toml::array* array = node.as_array();
  if (!array) return wrong_type(node, setting);
  if (array->size() != 2)
    return fmt::format("expected {}, got a list of {}", setting.type_text(), array->size());
  return read_items(*array, setting, values);
}

template <class T>
Problem read(const toml::node& node, const Setting& setting, std::vector<T>& values) {
  const toml::array* array = node.as_array();
  if (!array) return wrong_type(node, setting);
  std::vector<T> items(array->size());
  if (const auto problem = read_items(*array, setting, items)) return problem;
  values = items;
  return {};
}

template <class T>
Problem read(const toml::node& node, const Setting& setting, std::optional<T>& value) {
  T item{};
  if (const auto problem = read(node, setting, item)) return problem;
  value = item;
  return {};
}

}  // namespace

std::optional<std::string> read_toml_value(const toml::node& node, const Setting& setting) {
  return std::visit([&](auto* target) { return read(node, setting, *target); }, setting.target);
}

std::string toml_node_text(const toml::node& node) {
  if (node.is_floating_point()) return toml_text(node.as_floating_point()->get());
  if (node.is_string()) return toml_text(node.as_string()->get());
  std::ostringstream stream;
  node.visit([&](const auto& value) { stream << value; });
  std::string text = stream.str();
  std::ranges::replace(text, '\n', ' ');
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

}  // namespace wingbeat
