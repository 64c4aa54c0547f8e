#pragma once

#include <exception>
#include <string>

#include "core/io/error.hpp"
#include "core/parallel/comm.hpp"

namespace wingbeat {

// Runs `task` on rank 0 alone, for what one process must do, such as writing a file. What it
// throws is thrown on every rank, as InputError or InternalError. Collective.
template <class Task>
void on_root(const Comm& comm, const Task& task) {
  constexpr char input = 'i', internal = 'x';
  std::string failure;
  if (comm.is_root()) {
    try {
      task();
    } catch (const InputError& error) {
      failure = input + std::string(error.what());
    } catch (const std::exception& error) {
      failure = internal + std::string(error.what());
    }
  }
  failure = comm.broadcast(failure);
  if (failure.empty()) return;
  if (failure.front() == input) throw InputError(failure.substr(1));
  throw InternalError(failure.substr(1));
}

}  // namespace wingbeat
