#pragma once

#include <string>
#include <vector>

namespace wingbeat {

// What an iteration needs beside the solution to go on bit for bit, as a checkpoint holds it.
struct SolverMemory {
  std::string stage;                        // of the run: the name the stage has in its progress
  std::vector<double> numbers;              // the same on all ranks
  std::vector<std::vector<double>> fields;  // like w: [instance][owned cell][variable]
};

}  // namespace wingbeat
