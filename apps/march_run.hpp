#pragma once

#include "apps/march_output.hpp"
#include "apps/solution_output.hpp"
#include "flow/dual_time.hpp"
#include "structure/march_verdict.hpp"
#include "structure/section_march.hpp"

namespace wingbeat {

// What a march is measured from: flow and section at rest, in equilibrium.
struct RestState {
  std::vector<double> w;
  std::vector<double> y;
};

struct MarchRun {
  SolveStatus status = SolveStatus::iteration_limit;
  MarchSummary summary;
  TimeLevels levels;  // the newest
};

// What a checkpoint of a march is one of: a march alone, or a search for the flutter speed.
std::string march_stage(const Context& context);

// Whether a march has nothing more to find: it had come to its end, and the case asks for no more than it
// has.
bool is_complete(const Context& context, const StructureModel& model, const TimeLevels& levels,
                 const MarchCriteria& criteria, const std::string& until);

// Marches of one flow and section at any speeds, with rows of march.csv and lines of progress.
class Marcher {
 public:
  // All are kept by reference.
  Marcher(Context& context, FlowLevel<2>& level, const StructureModel& model, MarchTable& table);

  // Marches from the levels at their speed until the criteria give a verdict that ends it, or for the time
  // that the case allows; then, for as many `snapshots` at equal steps of phase, one more period, from phase
  // 0 on, whose pressures go to surface.csv. A march that an earlier run left goes on: the time that the case
  // allows is that of the whole. Collective.
  MarchRun run(const TimeLevels& start, const RestState& rest, const MarchCriteria& criteria,
               const std::string& until, int snapshots = 0);

 private:
  struct March;
  void go_on(March& march, const MarchProgress& progress);
  SolveStatus advance(March& march, bool is_kept);
  SolveStatus march_to_verdict(March& march, const MarchCriteria& criteria, const std::string& until,
                               MarchAssessment& found);
  bool is_too_large(const March& march, const MarchCriteria& criteria) const;
  SolveStatus take_snapshots(March& march, const MarchAssessment& found, int snapshots);
  void summarize(const March& march, MarchSummary& summary) const;
  TimeLevels levels_of(const March& march, bool is_over) const;

  Context& context_;
  FlowLevel<2>& level_;
  const StructureModel& model_;
  MarchTable& table_;
  DualTime<2> flow_;
};

}  // namespace wingbeat
