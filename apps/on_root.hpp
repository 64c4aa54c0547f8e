#pragma once

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "core/parallel/comm.hpp"

namespace wingbeat {

// The message of what a task throws, with a letter for its kind before it; empty where it does not throw.
std::string failure_of(const std::function<void()>& task);
std::string message_of(const std::string& failure);  // without the letter
// Throws InputError, InternalError or std::bad_alloc as that text tells; nothing where it is empty.
void throw_failure(const std::string& failure);

// Runs `task` on rank 0 alone, for what one process must do, such as writing a file. What it
// throws is thrown on every rank, as throw_failure does. Collective.
template <class Task>
void on_root(const Comm& comm, const Task& task) {
  throw_failure(comm.broadcast(comm.is_root() ? failure_of(task) : std::string()));
}

// The failure of the first rank that has one, on every rank. Collective.
std::string first_failure(const Comm& comm, const std::string& failure);

// Runs `task` on every rank, for what may fail on one and not on another, such as reading a file; its
// result. What it throws on the first rank that it fails on is thrown on every rank, likewise. Collective.
template <class Task>
auto on_all(const Comm& comm, const Task& task) {
  std::optional<std::invoke_result_t<const Task&>> result;
  throw_failure(first_failure(comm, failure_of([&] { result.emplace(task()); })));
  return *std::move(result);
}

}  // namespace wingbeat
