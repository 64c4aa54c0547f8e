#pragma once

#include <string>
#include <vector>

namespace wingbeat {

// What the analyses say of one design: numbers in the order of the outputs, with what they cost.
struct Evaluation {
  bool is_solved = false;
  std::string message;          // why not
  std::vector<double> values;   // [output]
  std::vector<double> seconds;  // [analysis]
  int solves = 0;               // designs tried on the way, of all analyses
};

struct GradientEvaluation {
  bool is_solved = false;
  std::string message;
  std::vector<std::vector<double>> derivatives;  // [output][variable]
  std::vector<double> seconds;                   // [analysis]
};

}  // namespace wingbeat
