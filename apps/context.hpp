#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/case_settings.hpp"
#include "apps/checkpoints.hpp"
#include "apps/stop_request.hpp"
#include "core/io/log.hpp"
#include "core/io/result.hpp"
#include "core/io/timer.hpp"
#include "core/parallel/comm.hpp"

namespace wingbeat {

class KeptFactors;

// A solved case like this one, in a folder, from which a run starts; and another on the line through both
// cases: this one lies `ahead` times their distance beyond the first.
struct Neighbour {
  std::filesystem::path folder;
  std::optional<std::filesystem::path> before{};
  double ahead = 0.0;
};

// What a recipe works with.
struct Context {
  const Comm& comm;
  const CaseSettings& settings;
  const KeySources& sources;
  std::filesystem::path output;                  // folder of the results; exists
  std::optional<std::filesystem::path> restart;  // solution to start from
  std::optional<Neighbour> neighbour;            // where flow and cycles are sought nearby; not a restart
  bool find_flutter;                             // of a march: --find-flutter
  bool check;                                    // of a gradient: --check
  bool retry_failed;                             // of a sweep: --retry-failed
  int planned_ranks;                             // of a partition: --ranks, or those that run
  int node_ranks;                                // of the whole job that share this node's memory
  Log& log;                                      // rank 0 speaks
  Timer& timer;
  Result& result;            // findings and message are the recipe's; written by rank 0 afterwards
  const StopRequest& stop;   // poll it where there is nothing to write
  Checkpoints& checkpoints;  // poll it where a checkpoint can be written
  bool is_restart_judged;    // the restart's case is compared with this one; else it is but a start
  KeptFactors* kept_factors = nullptr;  // of a sweep: what its points before this one left in memory

  // "case.toml:7: section.key", the head of a message about a key found wrong once the run has begun.
  std::string place(const std::string& key) const {
    const auto found = sources.find(key);
    return found == sources.end() ? key : found->second + ": " + key;
  }
};

}  // namespace wingbeat
