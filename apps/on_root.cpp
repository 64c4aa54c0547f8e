#include "apps/on_root.hpp"

#include <new>

#include "core/io/error.hpp"
#include "core/parallel/rank_texts.hpp"

namespace wingbeat {
namespace {

constexpr char input = 'i', memory = 'm', internal = 'x';

}  // namespace

std::string failure_of(const std::function<void()>& task) {
  try {
    task();
  } catch (const InputError& error) {
    return input + std::string(error.what());
  } catch (const std::bad_alloc& error) {
    return memory + std::string(error.what());
  } catch (const std::exception& error) {
    return internal + std::string(error.what());
  }
  return {};
}

std::string message_of(const std::string& failure) { return failure.substr(1); }

void throw_failure(const std::string& failure) {
  if (failure.empty()) return;
  if (failure.front() == input) throw InputError(message_of(failure));
  if (failure.front() == memory) throw std::bad_alloc();
  throw InternalError(message_of(failure));
}

std::string first_failure(const Comm& comm, const std::string& failure) {
  const int first = static_cast<int>(comm.min(failure.empty() ? comm.size() : comm.rank()));
  if (first == comm.size()) return {};
  return joined(comm, comm.rank() == first ? failure : std::string());
}

}  // namespace wingbeat
