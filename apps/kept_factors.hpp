#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "flow/flow_level.hpp"

namespace wingbeat {

// The factors of a cycle's harmonics, kept for the cycle of a case beside it: from nearby they precondition
// almost as well as its own, which cost more than a few Krylov iterations. They are let go once they have
// come to take notably more than when they were new.
class KeptFactors {
 public:
  using Harmonics = std::vector<std::shared_ptr<SchwarzSolver<std::complex<double>>>>;

  // Those kept, where they are of as many cells on every rank and as many harmonics; else none. Collective.
  Harmonics lent(const FlowLevel<2>& level, int harmonics);
  // After a solve that began with these: its Krylov iterations, and how often it factored anew.
  void keep(const Harmonics& factors, int linear_iterations, int factorizations);
  // What is solved next begins with factors of its own.
  void let_go() {
    factors_.clear();
    is_lent_ = false;
  }

 private:
  Harmonics factors_;
  bool is_lent_ = false;
  int iterations_when_new_ = 0;
};

}  // namespace wingbeat
