#include "apps/verbs.hpp"

#include <array>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "core/io/error.hpp"

// Recipes that end in every way a recipe can, in place of the program's own.
namespace wingbeat {

namespace {

SolveStatus succeed(Context& context) {
  const auto outer = context.timer.measure("outer");
  const auto inner = context.timer.measure("inner");
  context.result.findings["answer"] = 42;
  return SolveStatus::converged;
}

SolveStatus stall(Context& context) {
  context.result.message = "no further";
  return SolveStatus::stalled;
}

// Works until it is asked to stop, then writes its checkpoint; gives up after a minute.
SolveStatus wait(Context& context) {
  context.log.line("waiting");
  for (int i = 0; i < 6000; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (!context.stop.is_set()) continue;
    context.log.line("checkpoint");
    return SolveStatus::interrupted;
  }
  return SolveStatus::converged;
}

SolveStatus break_all(Context&) {
  ensure(false, "broken on purpose");
  return SolveStatus::converged;
}

// The last rank fails, the others wait for it in a collective call.
SolveStatus break_one(Context& context) {
  if (context.comm.rank() == context.comm.size() - 1) throw std::runtime_error("broken on one rank");
  context.comm.barrier();
  return SolveStatus::converged;
}

}  // namespace

std::span<const Verb> verbs() {
  static const std::array table{
      Verb{"succeed", "", {}, succeed, true},
      Verb{"stall", "", {}, stall},
      Verb{"wait", "", {}, wait},
      Verb{"break-all", "", {}, break_all},
      Verb{"break-one", "", {}, break_one},
  };
  return table;
}

}  // namespace wingbeat
