#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/context.hpp"
#include "apps/kept_factors.hpp"
#include "core/parallel/failure_agreement.hpp"

namespace wingbeat {

// A point of a sweep, to be run in a folder of its own.
struct SweepTask {
  std::string verb;
  const CaseSettings& settings;
  std::filesystem::path folder;
  bool is_begun = false;  // an earlier run's attempt may have left something there to go on from
  std::optional<Neighbour> neighbour{};  // solved points to start from
  KeptFactors& kept_factors;             // of the group's points before this one
};

// What became of it.
struct SweepOutcome {
  std::string status;  // of result.json
  std::string reason;  // its message
  nlohmann::ordered_json findings = nlohmann::ordered_json::object();
  bool from_neighbour = false;
  double seconds = 0.0;
};

// Runs the verb, from the neighbour if there is one and, where that does not converge, on its own. Faults of
// the case that all ranks meet are the point's, not the sweep's; `agreement` is the group's. Collective over
// the group.
SweepOutcome run_sweep_point(Context& outer, const Comm& group, FailureAgreement& agreement,
                             const SweepTask& task);

}  // namespace wingbeat
