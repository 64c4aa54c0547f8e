#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "structure/cycle_estimate.hpp"
#include "structure/motion_estimate.hpp"

namespace wingbeat {

enum class MarchVerdict { undecided, decays, grows, limit_cycle };
std::string_view to_string(MarchVerdict verdict);  // "limit-cycle", ...

struct MarchCriteria {
  double growth_tolerance = 0.02;        // on the error of the growth rate, relative to the rate
  std::optional<double> rate_tolerance;  // the same, absolute; either does
  double energy_tolerance = 1e-3;        // on the distance to a limit cycle's energy, relative
  double small_energy = 1e-4;            // energy up to which growth is that of small motion
  bool ends_when_large = false;          // motion that has outgrown small_energy has nothing more to show
};

// What a march has shown so far.
struct MarchAssessment {
  MarchVerdict verdict = MarchVerdict::undecided;
  std::optional<GrowthEstimate> growth;
  std::optional<CycleEstimate> cycle;
  std::optional<MarchedPeriod> last;  // the last whole period; its begin counts from the record's
};

// Growth from the later two thirds of the record, at most the last twelve periods of unit frequency; the
// limit cycle from its last periods (eq:march-verdict).
MarchAssessment assess(const StructureModel& model, const MotionRecord& record,
                       const MarchCriteria& criteria);

}  // namespace wingbeat
