#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "apps/context.hpp"
#include "core/io/csv.hpp"
#include "flow/forced_flow.hpp"
#include "flow/pseudo_time.hpp"
#include "flow/steady_sequence.hpp"
#include "structure/aeroelastic_problem.hpp"
#include "structure/staggered.hpp"

namespace wingbeat {

// The iterations of a run: lines of progress as they happen, and history.csv.
class History {
 public:
  explicit History(Context& context);

  void steady(const std::string& mesh, const PseudoTransientIteration& iteration);
  void coupled(const std::string& stage, const NewtonIteration& iteration,
               const AeroelasticResiduals& residuals, double omega, double reduced_velocity);
  void cycle(const std::string& stage, const PseudoTimeIteration& iteration);
  void staggered(const std::string& stage, const StaggeredIteration& iteration);
  void forced(const std::string& stage, const ForcedFlowIteration& iteration);
  // Replaces history.csv; rank 0.
  void write() const;

 private:
  double seconds() const;

  Context& context_;
  std::chrono::steady_clock::time_point start_;
  CsvTable table_;
};

}  // namespace wingbeat
