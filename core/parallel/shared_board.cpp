#include "core/parallel/shared_board.hpp"

#include <algorithm>
#include <exception>

#include "core/parallel/mpi_call.hpp"

namespace wingbeat {
namespace {

// The window's lock, given back whatever happens.
class WindowLock {
 public:
  explicit WindowLock(MPI_Win window) : window_(window) {
    check_mpi(MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, window_));
  }
  ~WindowLock() { MPI_Win_unlock(0, window_); }
  WindowLock(const WindowLock&) = delete;
  WindowLock& operator=(const WindowLock&) = delete;

 private:
  MPI_Win window_;
};

}  // namespace

SharedBoard::SharedBoard(const Comm& comm, std::span<const long> numbers)
    : numbers_(numbers.begin(), numbers.end()), exceptions_before_(std::uncaught_exceptions()) {
  const std::size_t held = comm.is_root() ? numbers.size() : 0;
  long* memory = nullptr;
  check_mpi(MPI_Win_allocate(static_cast<MPI_Aint>(held * sizeof(long)), sizeof(long), MPI_INFO_NULL,
                             comm.handle(), static_cast<void*>(&memory), &window_));
  if (comm.is_root()) {
    const WindowLock lock(window_);
    std::ranges::copy(numbers, memory);
  }
  comm.barrier();
}

SharedBoard::~SharedBoard() {
  if (std::uncaught_exceptions() == exceptions_before_) MPI_Win_free(&window_);
}

void SharedBoard::use(const std::function<void(std::span<long>)>& work) {
  const int count = mpi_count(numbers_.size());
  const WindowLock lock(window_);
  check_mpi(MPI_Get(numbers_.data(), count, MPI_LONG, 0, 0, count, MPI_LONG, window_));
  check_mpi(MPI_Win_flush(0, window_));
  work(numbers_);
  check_mpi(MPI_Put(numbers_.data(), count, MPI_LONG, 0, 0, count, MPI_LONG, window_));
  check_mpi(MPI_Win_flush(0, window_));
}

}  // namespace wingbeat
