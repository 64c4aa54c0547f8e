#include "apps/case_settings.hpp"

#include "core/io/case_file.hpp"
#include "core/io/setting_text.hpp"

namespace wingbeat {

void CaseSettings::describe(SettingRegistry& registry) {
  registry.add_section("mesh", "The section and the mesh around it.", mesh);
  registry.add_section("partition", "How cells are shared among ranks.", partition);
  registry.add_section("flow", "The free stream, the gas and the scheme.", flow);
  registry.add_section("pitch", "Pitch of the undeformed section, and the motion prescribed to it.", pitch);
  registry.add_section("time", "The period in time.", time);
  registry.add_section(
      "structure", "The pitch-plunge section, made dimensionless by semichord and omega_alpha.", structure);
  registry.add_section(
      "modal", "A structure by its matrices, in place of [structure], for pk with a table of Q(k).", modal);
  registry.add_section("flutter", "The flutter boundary and its linear start.", flutter);
  registry.add_section("lco", "Which limit cycles are computed.", lco);
  registry.add_section("march", "A time-accurate march of flow and section.", march);
  registry.add_section("pk", "The table of frequency and damping against reduced velocity.", pk);
  registry.add_section("design", "Shape variables and how the mesh follows them.", design);
  registry.add_section("gradient", "What is differentiated, and with respect to what.", gradient);
  registry.add_section("optimize", "What is optimised, by which variables, and how.", optimize);
  registry.add_section("sweep", "A verb run at many points, and which keys change from point to point.",
                       sweep);
  registry.add_section("solver", "How the equations are solved, and how far.", solver);
  registry.add_section("pseudo_time", "Runge-Kutta multigrid cycles of the flow.", pseudo_time);
  registry.add_section("staggered", "How flow and structure take turns in the staggered method.", staggered);
  registry.add_section("checkpoint", "How often a run writes what it can go on from.", checkpoint);
}

ResolvedCase resolve_case(const std::string& text, const std::string& path,
                          const std::vector<std::string>& overrides, const UsedSections& used_sections,
                          const std::string& reader, const std::string& override_place) {
  CaseFile file(text, path);
  for (const auto& assignment : overrides) file.add_override(assignment, override_place);
  ResolvedCase resolved;
  SettingRegistry registry;
  resolved.settings.describe(registry);
  file.apply(
      registry, [&] { return used_sections(resolved.settings); }, reader);
  resolved.text = resolved_case(registry);
  for (const auto& section : registry.sections())
    for (const auto& key : section.keys())
      if (!key.source.empty()) resolved.sources[section.name() + "." + key.name] = key.source;
  return resolved;
}

}  // namespace wingbeat
