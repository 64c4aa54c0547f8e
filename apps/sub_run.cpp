#include "apps/sub_run.hpp"

#include "apps/on_root.hpp"
#include "apps/run_case.hpp"
#include "core/io/file.hpp"
#include "core/io/setting_text.hpp"

namespace wingbeat {

SubRun::SubRun(Context& outer, const Comm& comm, const std::string& command, const CaseSettings& settings,
               std::filesystem::path output, SubRunOptions options)
    : settings_(settings),
      result_{.command = command, .ranks = comm.size(), .version = outer.result.version},
      stop_(comm, outer.stop),
      checkpoints_(comm, stop_, settings_.checkpoint, options.log ? *options.log : outer.log),
      context_{.comm = comm,
               .settings = settings_,
               .sources = outer.sources,
               .output = std::move(output),
               .restart = std::nullopt,
               .neighbour = std::move(options.neighbour),
               .find_flutter = false,
               .check = false,
               .retry_failed = false,
               .planned_ranks = comm.size(),
               .node_ranks = outer.node_ranks,
               .log = options.log ? *options.log : outer.log,
               .timer = timer_,
               .result = result_,
               .stop = stop_,
               .checkpoints = checkpoints_,
               .is_restart_judged = false,
               .kept_factors = options.kept_factors} {}

std::string case_text(CaseSettings settings, const KeySources& sources) {
  SettingRegistry registry;
  settings.describe(registry);
  for (SettingSection& section : registry.sections())
    for (Setting& key : section.keys())
      if (const auto found = sources.find(section.name() + "." + key.name); found != sources.end())
        key.source = found->second;
  return resolved_case(registry);
}

Result run_verb_within(Context& outer, const std::string& verb, const CaseSettings& settings,
                       const std::filesystem::path& output) {
  SubRun run(outer, outer.comm, verb, settings, output);
  on_root(outer.comm, [&] {
    write_file(output / "case.toml", case_head(outer.comm, verb, "within " + outer.output.string()) +
                                         case_text(settings, outer.sources));
  });
  run_recipe(find_verb(verb), run.context());
  return run.result();
}

}  // namespace wingbeat
