#pragma once

#include <mpi.h>

#include <functional>
#include <span>
#include <vector>

#include "core/parallel/comm.hpp"

namespace wingbeat {

// A few numbers, held by rank 0, that any rank of a group may read and change whenever it likes, one rank at
// a time: a queue of work without a rank that serves it. On one machine rank 0 takes no part in that; across
// machines its MPI answers when it is next called.
class SharedBoard {
 public:
  // `numbers`: as rank 0 gives them. Collective, as is destruction, except on a rank that an exception takes
  // away: the others may never come.
  SharedBoard(const Comm& comm, std::span<const long> numbers);
  ~SharedBoard();
  SharedBoard(const SharedBoard&) = delete;
  SharedBoard& operator=(const SharedBoard&) = delete;

  // Hands the numbers to `work`, which may change them, while no other rank has them. Not collective.
  void use(const std::function<void(std::span<long>)>& work);

 private:
  MPI_Win window_ = MPI_WIN_NULL;
  std::vector<long> numbers_;
  int exceptions_before_;
};

}  // namespace wingbeat
