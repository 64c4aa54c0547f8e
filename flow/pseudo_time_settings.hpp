#pragma once

#include <optional>
#include <string>

#include "core/io/settings.hpp"
#include "flow/pseudo_time.hpp"

namespace wingbeat {

// [pseudo_time]: Runge-Kutta multigrid cycles of the flow.
struct PseudoTimeSettings {
  std::optional<double> cfl;  // what suits the scheme when empty
  double smoothing = 2.0;
  std::string cycle = "w";
  std::optional<int> levels;  // as many as every block allows when empty
  bool full_multigrid = true;
  int max_cycles = 5000;
  int max_retreats = 6;

  PseudoTimeOptions options(const Scheme& scheme, double tolerance) const;
  // Cells that blocks are cut at multiples of, so that every one of them can be coarsened.
  int granularity() const;
  void describe(SettingSection& keys);
};

}  // namespace wingbeat
