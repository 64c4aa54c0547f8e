#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "apps/context.hpp"
#include "flow/loads.hpp"
#include "structure/march_verdict.hpp"

namespace wingbeat {

// What one time step of a march has led to.
struct MarchedStep {
  double time = 0.0;
  double reduced_velocity = 0.0;
  double energy = 0.0;  // of the departure from rest
  std::span<const double> y;
  Loads<double> loads;
  int flow_iterations = 0;
  int coupling_iterations = 0;
};

// march.csv, a row a step: every row is on disk before the next step begins. Rank 0 writes.
class MarchTable {
 public:
  // Replaces the file of an earlier run; begins with the rows of one that is gone on with. Collective.
  explicit MarchTable(const Context& context, std::vector<double> rows = {});
  void add(const MarchedStep& step);
  // Of all steps so far, on rank 0: numbers from which the same rows follow.
  const std::vector<double>& rows() const { return rows_; }

 private:
  void write(std::span<const double> row);

  const Context& context_;
  std::vector<double> rows_;
  std::ofstream file_;
};

// A march and what it has shown.
struct MarchSummary {
  double reduced_velocity = 0.0;
  MarchAssessment assessment;
  double pitch_amplitude_deg = 0.0;  // of the last period's first harmonics
  double plunge_amplitude = 0.0;
  long time_steps = 0;
};

// The numbers of a march as result.json names them; what is unknown is null.
nlohmann::ordered_json march_entry(const CaseSettings& settings, const MarchSummary& summary);
void print_march(Context& context, const MarchSummary& summary);

}  // namespace wingbeat
