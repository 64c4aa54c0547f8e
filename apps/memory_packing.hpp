#pragma once

#include <string>

#include "apps/solver_memory.hpp"
#include "flow/dual_time.hpp"
#include "flow/pseudo_time.hpp"
#include "structure/staggered.hpp"
#include "structure/time_marching.hpp"

namespace wingbeat {

// What every kind of iteration goes on with, to and from what a checkpoint holds of it.
SolverMemory packed(const std::string& stage, PseudoTimeMemory memory);
PseudoTimeMemory unpacked_pseudo_time(SolverMemory memory);

// The stage of a cycle whose flow and structure take turns, beside other stages of that name.
std::string turns_stage(const std::string& cycle);
bool is_of_turns(const SolverMemory& memory);

// `rest`: the state of rest that the cycle's start was measured from (one instance).
struct TurnsMemory {
  StaggeredMemory staggered;
  AeroelasticState rest;
};
SolverMemory packed(const std::string& stage, StaggeredMemory memory, const AeroelasticState& rest);
TurnsMemory unpacked_turns(SolverMemory memory);

// Of a march: flow and structure between two steps, and whether the march has come to its end.
struct MarchMemory {
  bool is_over = false;
  DualTimeMemory flow;
  TimeMarchingMemory structure;
};
SolverMemory packed(const std::string& stage, MarchMemory memory);
MarchMemory unpacked_march(SolverMemory memory);

}  // namespace wingbeat
