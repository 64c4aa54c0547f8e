#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "apps/checkpoint_settings.hpp"
#include "apps/solver_memory.hpp"
#include "apps/stop_request.hpp"
#include "core/io/log.hpp"

namespace wingbeat {

// When a run writes a checkpoint, and what an earlier one's solver knew.
class Checkpoints {
 public:
  // All are kept by reference.
  Checkpoints(const Comm& comm, const StopRequest& stop, const CheckpointSettings& settings, Log& log);

  // Poll it after every iteration: false where the run is to end. Where a checkpoint is due, `save` writes it
  // first; one that cannot be written is told, and the run goes on with the last. Collective.
  bool goes_on(const std::function<void()>& save);

  // The folder's solution is of a later stage than steady flow, which must not replace it on the way there.
  void stay_ahead() { is_ahead_ = true; }
  bool is_ahead() const { return is_ahead_; }

  // Keeps what a restart's solver knew until the stage that it belongs to takes it.
  void remember(SolverMemory memory) { memory_ = std::move(memory); }
  const std::optional<SolverMemory>& memory() const { return memory_; }
  bool remembers(const std::string& stage) const { return memory_ && memory_->stage == stage; }
  std::optional<SolverMemory> recall(const std::string& stage);
  void forget() { memory_.reset(); }  // where what is solved next is not what the solver knew

 private:
  using Clock = std::chrono::steady_clock;
  void schedule(Clock::duration cost);

  const Comm& comm_;
  const StopRequest& stop_;
  const CheckpointSettings& settings_;
  Log& log_;
  Clock::time_point next_;  // rank 0's clock decides
  bool is_ahead_ = false;
  std::optional<SolverMemory> memory_;
};

}  // namespace wingbeat
