#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/context.hpp"

namespace wingbeat {

// What a run within a run may have of its own besides.
struct SubRunOptions {
  Log* log = nullptr;  // none: the outer run's
  std::optional<Neighbour> neighbour{};
  KeptFactors* kept_factors = nullptr;
};

// A run within a run: a context of its own, with its own settings, results, times and folder, on ranks of the
// outer one.
class SubRun {
 public:
  // `outer` is kept by reference. Its restart is not passed on; one given to context() is a start, whatever
  // case it is of.
  SubRun(Context& outer, const Comm& comm, const std::string& command, const CaseSettings& settings,
         std::filesystem::path output, SubRunOptions options = {});
  SubRun(const SubRun&) = delete;
  SubRun& operator=(const SubRun&) = delete;

  Context& context() { return context_; }
  const Result& result() const { return result_; }

 private:
  CaseSettings settings_;
  Timer timer_;
  Result result_;
  StopRequest stop_;
  Checkpoints checkpoints_;
  Context context_;
};

// A case as text, like the one a run leaves; keys that the outer run was not given and needs not are left
// out.
std::string case_text(CaseSettings settings, const KeySources& sources);

// Runs a verb on a case so, and leaves its folder as the verb would. Collective.
Result run_verb_within(Context& outer, const std::string& verb, const CaseSettings& settings,
                       const std::filesystem::path& output);

}  // namespace wingbeat
