#include "apps/memory_packing.hpp"

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// Takes numbers off the front of a list.
class Numbers {
 public:
  explicit Numbers(const std::vector<double>& values) : values_(values) {}

  double next() {
    ensure(at_ < values_.size(), "a checkpoint's numbers of its solver end too early");
    return values_[at_++];
  }
  int count() { return static_cast<int>(next()); }
  std::vector<double> next(std::size_t length) {
    std::vector<double> part(length);
    for (double& value : part) value = next();
    return part;
  }
  std::size_t left() const { return values_.size() - at_; }

 private:
  const std::vector<double>& values_;
  std::size_t at_ = 0;
};

void append(std::vector<double>& numbers, const AeroelasticState& state) {
  numbers.insert(numbers.end(), {state.omega, state.r});
  numbers.insert(numbers.end(), state.y.begin(), state.y.end());
}

constexpr const char* by_turns = ", by turns";
constexpr std::size_t rest_size = 4;  // y of one instance

}  // namespace

SolverMemory packed(const std::string& stage, PseudoTimeMemory memory) {
  return {stage,
          {static_cast<double>(memory.cycles), static_cast<double>(memory.retreats), memory.cfl},
          {std::move(memory.good)}};
}

PseudoTimeMemory unpacked_pseudo_time(SolverMemory memory) {
  Numbers numbers(memory.numbers);
  PseudoTimeMemory kept;
  kept.cycles = numbers.count();
  kept.retreats = numbers.count();
  kept.cfl = numbers.next();
  kept.good = std::move(memory.fields.at(0));
  return kept;
}

std::string turns_stage(const std::string& cycle) { return cycle + by_turns; }

bool is_of_turns(const SolverMemory& memory) { return memory.stage.ends_with(by_turns); }

SolverMemory packed(const std::string& stage, StaggeredMemory memory, const AeroelasticState& rest) {
  SolverMemory kept{stage, {}, {}};
  for (const int count : {memory.iterations, memory.flow_cycles, memory.recoveries, memory.steps_since_best,
                          memory.settled_steps})
    kept.numbers.push_back(count);
  const auto last = memory.last_point.value_or(EnergySearch::Point{0.0, 0.0});
  const AeroelasticResiduals& residuals = memory.best_residuals;
  kept.numbers.insert(kept.numbers.end(),
                      {memory.relaxation, memory.energy, memory.previous_r, memory.start_omega,
                       memory.start_r, memory.last_point ? 1.0 : 0.0, last.energy, last.mismatch,
                       residuals.flow, residuals.structure, residuals.phase, residuals.energy});
  append(kept.numbers, rest);
  append(kept.numbers, memory.best);
  kept.fields = {std::move(memory.best.w), rest.w};
  return kept;
}

TurnsMemory unpacked_turns(SolverMemory memory) {
  Numbers numbers(memory.numbers);
  TurnsMemory kept;
  StaggeredMemory& turns = kept.staggered;
  for (int* count : {&turns.iterations, &turns.flow_cycles, &turns.recoveries, &turns.steps_since_best,
                     &turns.settled_steps})
    *count = numbers.count();
  for (double* number :
       {&turns.relaxation, &turns.energy, &turns.previous_r, &turns.start_omega, &turns.start_r})
    *number = numbers.next();
  const bool has_last = numbers.next() != 0.0;
  const double energy = numbers.next(), mismatch = numbers.next();
  if (has_last) turns.last_point = EnergySearch::Point{energy, mismatch};
  AeroelasticResiduals& residuals = turns.best_residuals;
  for (double* number : {&residuals.flow, &residuals.structure, &residuals.phase, &residuals.energy})
    *number = numbers.next();
  kept.rest.omega = numbers.next();
  kept.rest.r = numbers.next();
  kept.rest.y = numbers.next(rest_size);
  turns.best.omega = numbers.next();
  turns.best.r = numbers.next();
  turns.best.y = numbers.next(numbers.left());
  turns.best.w = std::move(memory.fields.at(0));
  kept.rest.w = std::move(memory.fields.at(1));
  return kept;
}

SolverMemory packed(const std::string& stage, MarchMemory memory) {
  const DualTimeMemory& flow = memory.flow;
  const TimeMarchingMemory& structure = memory.structure;
  SolverMemory kept{stage, {memory.is_over ? 1.0 : 0.0, flow.dt, flow.shift, flow.round_off}, {}};
  for (const int number :
       {static_cast<int>(flow.is_linearization_due), static_cast<int>(flow.are_factors_due),
        flow.fewest_iterations, flow.excess_iterations})
    kept.numbers.push_back(number);
  for (const MotionState& motion : {flow.linearized_motion, flow.factored_motion})
    kept.numbers.insert(kept.numbers.end(), {motion.pitch, motion.pitch_rate, motion.plunge_rate});
  const auto modes = structure.response.rows();
  kept.numbers.push_back(static_cast<double>(modes));
  const auto response = structure.response.reshaped();
  kept.numbers.insert(kept.numbers.end(), response.begin(), response.end());
  for (const auto& forces : structure.forces)
    kept.numbers.insert(kept.numbers.end(), forces.begin(), forces.end());
  if (!flow.is_linearization_due) kept.fields.push_back(std::move(memory.flow.linearized_w));
  if (!flow.are_factors_due) kept.fields.push_back(std::move(memory.flow.factored_w));
  return kept;
}

MarchMemory unpacked_march(SolverMemory memory) {
  Numbers numbers(memory.numbers);
  MarchMemory kept;
  kept.is_over = numbers.next() != 0.0;
  DualTimeMemory& flow = kept.flow;
  for (double* number : {&flow.dt, &flow.shift, &flow.round_off}) *number = numbers.next();
  flow.is_linearization_due = numbers.next() != 0.0;
  flow.are_factors_due = numbers.next() != 0.0;
  flow.fewest_iterations = numbers.count();
  flow.excess_iterations = numbers.count();
  for (MotionState* motion : {&flow.linearized_motion, &flow.factored_motion}) {
    motion->pitch = numbers.next();
    motion->pitch_rate = numbers.next();
    motion->plunge_rate = numbers.next();
  }
  const auto modes = static_cast<std::size_t>(numbers.count());
  const std::vector<double> response = numbers.next(2 * modes * modes);
  const auto m = static_cast<Eigen::Index>(modes);
  kept.structure.response = Eigen::Map<const Eigen::MatrixXd>(response.data(), m, 2 * m);
  while (numbers.left() > 0) {
    const std::vector<double> forces = numbers.next(modes);
    kept.structure.forces.push_back(Eigen::Map<const Eigen::VectorXd>(forces.data(), m));
  }
  std::size_t next = 0;
  if (!flow.is_linearization_due) flow.linearized_w = std::move(memory.fields.at(next++));
  if (!flow.are_factors_due) flow.factored_w = std::move(memory.fields.at(next++));
  return kept;
}

}  // namespace wingbeat
