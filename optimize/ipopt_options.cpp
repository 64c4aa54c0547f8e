#include "optimize/ipopt_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

#include "core/io/nearest_name.hpp"
#include "optimize/statement_words.hpp"

namespace wingbeat {
namespace {

// An option that the adapter sets or needs as it is.
struct OwnedOption {
  std::string_view name;
  std::string_view reason;  // and what to do instead
  std::string_view permitted = {};
};

constexpr std::string_view of_tolerance = "follows optimize.tolerance; set that key instead";
constexpr std::string_view of_scaling =
    "objective, constraints and variables are scaled already; leave it out";
constexpr std::string_view of_bounds = "bounds hold exactly as the case gives them; leave it out";
constexpr std::string_view of_text = "Ipopt's text goes to the log; set print_level instead";
constexpr std::string_view of_start = "every run starts without multipliers; leave it out";
constexpr std::string_view of_result = "the result would lack its multipliers; leave it out";
constexpr std::string_view of_hessian = "second derivatives are not available; leave it out";

constexpr std::array owned_options = std::to_array<OwnedOption>({
    {"max_iter", "follows optimize.max_iterations; set that key instead"},
    {"tol", of_tolerance},
    {"dual_inf_tol", of_tolerance},
    {"compl_inf_tol", of_tolerance},
    {"hessian_approximation", of_hessian, "limited-memory"},
    {"jacobian_approximation", "gradients are exact; leave it out", "exact"},
    {"nlp_scaling_method", of_scaling, "none"},
    {"nlp_scaling_max_gradient", of_scaling},
    {"nlp_scaling_min_value", of_scaling},
    {"nlp_scaling_obj_target_gradient", of_scaling},
    {"nlp_scaling_constr_target_gradient", of_scaling},
    {"obj_scaling_factor", of_scaling},
    {"bound_relax_factor", of_bounds},
    {"honor_original_bounds", of_bounds},
    {"nlp_lower_bound_inf", of_bounds},
    {"nlp_upper_bound_inf", of_bounds},
    {"output_file", of_text},
    {"file_print_level", of_text},
    {"option_file_name", "no file of options is read; give the options in the case"},
    {"print_options_documentation", of_text},
    {"print_options_latex_mode", of_text},
    {"suppress_all_output", of_text},
    {"warm_start_init_point", of_start},
    {"warm_start_entire_iterate", of_start},
    {"warm_start_same_structure", of_start},
    {"skip_finalize_solution_call", of_result},
    {"replace_bounds", of_result},
});

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string after(std::string_view head, const std::string& tail) {
  return tail.empty() ? std::string() : std::string(head) + tail;
}

std::string unknown_option(const std::string& name, std::span<const IpoptOptionRule> rules) {
  std::vector<std::string> names;
  for (const IpoptOptionRule& rule : rules) names.push_back(rule.name);
  const std::string nearest = nearest_name(name, names);
  return nearest.empty() ? "Ipopt has no such option; see the list of options in its manual"
                         : fmt::format("Ipopt has no such option; did you mean {}?", nearest);
}

std::string number_fault(const std::optional<double>& value, std::string_view type, const Bounds& range) {
  if (!value) return fmt::format("expected {}{}", type, after(": ", range.text()));
  if (!range.contains(*value)) return "out of range; allowed: " + range.text();
  return {};
}

std::string text_fault(const std::string& value, const std::vector<std::string>& allowed) {
  const auto takes = [&](const std::string& text) { return text == "*" || text == value; };
  if (std::ranges::any_of(allowed, takes)) return {};
  const std::string nearest = nearest_name(value, allowed);
  return fmt::format("allowed: {}{}", fmt::join(allowed, ", "),
                     nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
}

std::string value_fault(const std::string& value, const IpoptOptionRule& rule) {
  switch (rule.kind) {
    case IpoptOptionRule::Kind::number:
      return number_fault(parse_number(value), "a number", rule.range);
    case IpoptOptionRule::Kind::integer:
      return number_fault(parse_integer(value), "an integer", rule.range);
    case IpoptOptionRule::Kind::text:
      return text_fault(value, rule.allowed);
  }
  return {};
}

std::string assignment_fault(const IpoptAssignment& given, std::span<const IpoptOptionRule> rules) {
  const auto owned = std::ranges::find(owned_options, given.name, &OwnedOption::name);
  if (owned != owned_options.end())
    return owned->permitted == given.value ? std::string() : std::string(owned->reason);
  const auto rule = std::ranges::find(rules, given.name, &IpoptOptionRule::name);
  return rule == rules.end() ? unknown_option(given.name, rules) : value_fault(given.value, *rule);
}

}  // namespace

std::optional<IpoptAssignment> parse_assignment(std::string_view text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string_view::npos) return std::nullopt;
  const std::string_view name = trimmed(text.substr(0, sign)), value = trimmed(text.substr(sign + 1));
  if (name.empty() || value.empty()) return std::nullopt;
  return IpoptAssignment{std::string(name), std::string(value)};
}

std::optional<double> parse_number(std::string_view text) {
  const auto value = parse_whole<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<int> parse_integer(std::string_view text) { return parse_whole<int>(text); }

std::vector<IpoptAssignment> own_assignments(int max_iterations, double tolerance) {
  constexpr double constraint_tolerance = 1e-5;
  constexpr double acceptable_factor = 10.0;
  const std::string exact = fmt::format("{}", tolerance);
  const std::string acceptable = fmt::format("{}", acceptable_factor * tolerance);
  return {
      {"max_iter", fmt::format("{}", max_iterations)},
      {"hessian_approximation", "limited-memory"},
      {"nlp_scaling_method", "none"},
      {"mu_strategy", "adaptive"},
      // The error that tol bounds is divided by the multipliers where they are large; the others are not.
      {"tol", exact},
      {"dual_inf_tol", exact},
      {"compl_inf_tol", exact},
      {"constr_viol_tol", fmt::format("{}", constraint_tolerance)},
      {"acceptable_tol", acceptable},
      {"acceptable_dual_inf_tol", acceptable},
      {"acceptable_compl_inf_tol", acceptable},
      {"acceptable_constr_viol_tol", fmt::format("{}", acceptable_factor * constraint_tolerance)},
      // A restoration minimises 1000 times the violation, for which the tolerance of the objective is too
      // tight.
      {"resto.dual_inf_tol", "1"},
      // Ipopt would leave the bounds by this part of them.
      {"bound_relax_factor", "0"},
      {"sb", "yes"},  // no banner
  };
}

std::vector<std::string> assignment_faults(std::span<const std::string> texts,
                                           std::span<const IpoptOptionRule> rules) {
  std::vector<std::string> faults;
  std::set<std::string> names;
  for (const std::string& text : texts) {
    const auto given = parse_assignment(text);
    if (!given) {
      faults.push_back(fmt::format("\"{}\": expected name = value, as in max_soc = 4", text));
      continue;
    }
    std::string fault = assignment_fault(*given, rules);
    if (fault.empty() && !names.insert(given->name).second) fault = "given more than once; keep one";
    if (!fault.empty()) faults.push_back(fmt::format("{} = {}: {}", given->name, given->value, fault));
  }
  return faults;
}

}  // namespace wingbeat
