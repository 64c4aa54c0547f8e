#include "apps/neighbour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/flow_setup.hpp"
#include "apps/restart.hpp"
#include "apps/solution_names.hpp"

namespace wingbeat {
namespace {

// Cycles are the same whose frequencies and speeds differ by less than these parts.
constexpr double frequency_reach = 0.1, speed_reach = 0.3;

StoredSolution read_in_proportion(const Context& context, const FlowLevel<2>& level,
                                  const std::filesystem::path& file) {
  StoredSolution stored = read_stored_solution(context, level, file);
  const double ratio = context.settings.flow.mach / stored.data.at(solution_names::mach_name).at(0);
  constexpr std::size_t n = state_size<2>;
  for (std::size_t cell = 0; cell < stored.state.w.size(); cell += n) {
    double* w = stored.state.w.data() + cell;
    w[3] += 0.5 * (ratio * ratio - 1.0) * (w[1] * w[1] + w[2] * w[2]) / w[0];
    w[1] *= ratio;
    w[2] *= ratio;
  }
  return stored;
}

void carry_on(std::vector<double>& values, const std::vector<double>& before, double ahead) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += ahead * (values[i] - before[i]);
}

std::vector<double> flow_of(const Context& context, const FlowLevel<2>& level,
                            const std::filesystem::path& folder) {
  const StoredSolution stored = read_in_proportion(context, level, folder / "solution.cgns");
  std::vector<double> mean(level.domain.state_count(), 0.0);
  for (std::size_t i = 0; i < stored.state.w.size(); ++i)
    mean[i % mean.size()] += stored.state.w[i] / stored.instances();
  return mean;
}

std::vector<AeroelasticState> cycles_of(const Context& context, const FlowLevel<2>& level,
                                        const std::filesystem::path& folder) {
  const int instances = 2 * context.settings.time.harmonics + 1;
  std::vector<AeroelasticState> cycles;
  for (int number = 1;; ++number) {
    double is_there = std::filesystem::is_regular_file(folder / flutter_file(number)) ? 1.0 : 0.0;
    context.comm.broadcast(is_there);
    if (is_there == 0.0) return cycles;
    StoredSolution stored = read_in_proportion(context, level, folder / flutter_file(number));
    if (stored.instances() == instances && !stored.time_step()) cycles.push_back(std::move(stored.state));
  }
}

double speed_of(const CaseSettings& settings, const AeroelasticState& cycle) {
  return section_kinematics(settings).reduced_velocity(cycle.r);
}

}  // namespace

std::string flutter_file(int number) {
  return number == 1 ? "solution.cgns" : fmt::format("solution-{}.cgns", number);
}

std::vector<double> neighbouring_flow(const Context& context, const FlowLevel<2>& level) {
  const Neighbour& neighbour = *context.neighbour;
  std::vector<double> w = flow_of(context, level, neighbour.folder);
  if (neighbour.before) carry_on(w, flow_of(context, level, *neighbour.before), neighbour.ahead);
  return w;
}

std::vector<AeroelasticState> neighbouring_cycles(const Context& context, const FlowLevel<2>& level) {
  const Neighbour& neighbour = *context.neighbour;
  std::vector<AeroelasticState> cycles = cycles_of(context, level, neighbour.folder);
  if (!neighbour.before) return cycles;
  const std::vector<AeroelasticState> before = cycles_of(context, level, *neighbour.before);
  for (AeroelasticState& cycle : cycles) {
    const AeroelasticState* same =
        cycle_near(context.settings, speed_of(context.settings, cycle), cycle.omega, before);
    if (!same) continue;
    carry_on(cycle.w, same->w, neighbour.ahead);
    carry_on(cycle.y, same->y, neighbour.ahead);
    cycle.omega += neighbour.ahead * (cycle.omega - same->omega);
    cycle.r *= std::pow(cycle.r / same->r, neighbour.ahead);
  }
  return cycles;
}

const AeroelasticState* cycle_near(const CaseSettings& settings, double reduced_velocity, double frequency,
                                   const std::vector<AeroelasticState>& cycles) {
  const AeroelasticState* nearest = nullptr;
  double least = 1.0;
  for (const AeroelasticState& cycle : cycles) {
    const double distance =
        std::max(std::abs(cycle.omega / frequency - 1.0) / frequency_reach,
                 std::abs(speed_of(settings, cycle) / reduced_velocity - 1.0) / speed_reach);
    if (distance >= least) continue;
    least = distance;
    nearest = &cycle;
  }
  return nearest;
}

}  // namespace wingbeat
