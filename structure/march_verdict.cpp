#include "structure/march_verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace wingbeat {
namespace {

constexpr double growth_periods = 12.0;  // of 2 pi
constexpr double cycle_periods = 7.0;    // of the motion
constexpr double share_looked_at = 2.0 / 3.0;

MotionRecord latest(const MotionRecord& record, std::size_t width, double time) {
  const std::size_t samples = record.y.size() / width;
  const auto wanted = static_cast<std::size_t>(std::ceil(time / record.dtau)) + 1;
  return {record.y.last(std::min(samples, wanted) * width), record.dtau};
}

}  // namespace

std::string_view to_string(MarchVerdict verdict) {
  constexpr std::array<std::string_view, 4> names{"undecided", "decays", "grows", "limit-cycle"};
  return names[static_cast<std::size_t>(verdict)];
}

MarchAssessment assess(const StructureModel& model, const MotionRecord& record,
                       const MarchCriteria& criteria) {
  const auto width = static_cast<std::size_t>(2 * model.size());
  const double time = static_cast<double>(record.y.size() / width) * record.dtau;
  constexpr double turn = 2.0 * std::numbers::pi;
  MarchAssessment result;
  result.growth =
      estimate_growth(model, latest(record, width, std::min(share_looked_at * time, growth_periods * turn)));
  const double frequency = result.growth ? std::max(result.growth->frequency, 0.05) : 1.0;
  const MotionRecord end = latest(record, width, cycle_periods * turn / frequency);
  const std::vector<MarchedPeriod> periods = periods_of(model, end);
  result.cycle = estimate_cycle(periods);
  if (!periods.empty()) {
    result.last = periods.back();
    result.last->begin += static_cast<double>((record.y.size() - end.y.size()) / width) * record.dtau;
  }

  if (result.cycle && result.cycle->energy_error <= criteria.energy_tolerance * result.cycle->energy) {
    result.verdict = MarchVerdict::limit_cycle;
  } else if (result.growth && result.last && result.last->energy <= criteria.small_energy) {
    const GrowthEstimate& growth = *result.growth;
    const bool is_known = growth.rate_error <= criteria.growth_tolerance * std::abs(growth.rate) ||
                          (criteria.rate_tolerance && growth.rate_error <= *criteria.rate_tolerance);
    if (is_known) result.verdict = growth.rate > 0.0 ? MarchVerdict::grows : MarchVerdict::decays;
  }
  return result;
}

}  // namespace wingbeat
