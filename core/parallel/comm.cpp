#include "core/parallel/comm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel/mpi_call.hpp"

namespace wingbeat {
namespace {

constexpr int message_tag = 1;

// Up to this many values in all, every rank gathers everything and sums for itself.
constexpr std::size_t gather_limit = 1 << 14;

// One latency: suits the handful of inner products of a Krylov step.
void sum_everywhere(MPI_Comm comm, int size, std::span<double> values) {
  const std::size_t n = values.size();
  std::vector<double> all(n * size);
  check_mpi(
      MPI_Allgather(values.data(), mpi_count(n), MPI_DOUBLE, all.data(), mpi_count(n), MPI_DOUBLE, comm));
  std::copy_n(all.begin(), n, values.begin());
  for (int rank = 1; rank < size; ++rank)
    for (std::size_t i = 0; i < n; ++i) values[i] += all[rank * n + i];
}

// Each rank sums one slice, then all share the slices: traffic independent of the number of ranks.
void sum_in_slices(MPI_Comm comm, int rank, int size, std::span<double> values) {
  const std::size_t n = values.size();
  std::vector<int> counts(size), starts(size), own_counts(size), own_starts(size);
  const auto begin_of = [&](int r) { return n * r / size; };
  for (int r = 0; r < size; ++r) {
    starts[r] = mpi_count(begin_of(r));
    counts[r] = mpi_count(begin_of(r + 1) - begin_of(r));
  }
  const int slice = counts[rank];
  for (int r = 0; r < size; ++r) {
    own_counts[r] = slice;
    own_starts[r] = mpi_count(static_cast<std::size_t>(slice) * r);
  }
  std::vector<double> parts(static_cast<std::size_t>(slice) * size);
  check_mpi(MPI_Alltoallv(values.data(), counts.data(), starts.data(), MPI_DOUBLE, parts.data(),
                          own_counts.data(), own_starts.data(), MPI_DOUBLE, comm));
  for (int r = 1; r < size; ++r)
    for (int i = 0; i < slice; ++i) parts[i] += parts[static_cast<std::size_t>(r) * slice + i];
  check_mpi(MPI_Allgatherv(parts.data(), slice, MPI_DOUBLE, values.data(), counts.data(), starts.data(),
                           MPI_DOUBLE, comm));
}

template <class T>
std::vector<std::vector<T>> exchange_all(const Comm& comm, const std::vector<std::vector<T>>& outgoing) {
  const int size = comm.size();
  std::vector<int> send_counts(size), receive_counts(size);
  for (int r = 0; r < size; ++r) send_counts[r] = mpi_count(outgoing.at(r).size());
  check_mpi(MPI_Alltoall(send_counts.data(), 1, MPI_INT, receive_counts.data(), 1, MPI_INT, comm.handle()));

  std::vector<std::vector<T>> incoming(size);
  std::vector<MPI_Request> requests;
  for (int r = 0; r < size; ++r) {
    incoming[r].resize(receive_counts[r]);
    if (receive_counts[r] > 0 && r != comm.rank())
      check_mpi(MPI_Irecv(incoming[r].data(), receive_counts[r], mpi_type<T>(), r, message_tag, comm.handle(),
                          &requests.emplace_back()));
  }
  for (int r = 0; r < size; ++r)
    if (send_counts[r] > 0 && r != comm.rank())
      check_mpi(MPI_Isend(outgoing[r].data(), send_counts[r], mpi_type<T>(), r, message_tag, comm.handle(),
                          &requests.emplace_back()));
  incoming[comm.rank()] = outgoing[comm.rank()];
  check_mpi(MPI_Waitall(mpi_count(requests.size()), requests.data(), MPI_STATUSES_IGNORE));
  return incoming;
}

// One message a rank: the total may exceed what an MPI count can say.
template <class T>
std::vector<T> gather_on_root(const Comm& comm, std::span<const T> values) {
  const std::vector<long> counts = comm.all_gather(static_cast<long>(values.size()));
  if (!comm.is_root()) {
    if (!values.empty())
      check_mpi(
          MPI_Send(values.data(), mpi_count(values.size()), mpi_type<T>(), 0, message_tag, comm.handle()));
    return {};
  }
  std::size_t total = 0;
  for (const long count : counts) total += static_cast<std::size_t>(count);
  std::vector<T> all(total);
  T* position = std::ranges::copy(values, all.data()).out;
  for (int r = 1; r < comm.size(); ++r) {
    if (counts[r] == 0) continue;
    check_mpi(MPI_Recv(position, static_cast<int>(counts[r]), mpi_type<T>(), r, message_tag, comm.handle(),
                       MPI_STATUS_IGNORE));
    position += counts[r];
  }
  return all;
}

}  // namespace

Comm::Comm(MPI_Comm handle) : handle_(handle) {
  // Errors come back as codes, so that check_mpi can name rank and place.
  check_mpi(MPI_Comm_set_errhandler(handle_, MPI_ERRORS_RETURN));
  check_mpi(MPI_Comm_rank(handle_, &rank_));
  check_mpi(MPI_Comm_size(handle_, &size_));
}

SplitComm::SplitComm(const Comm& comm, int color)
    : comm_([&] {
        MPI_Comm part = MPI_COMM_NULL;
        check_mpi(MPI_Comm_split(comm.handle(), color, comm.rank(), &part));
        return Comm(part);
      }()) {}

SplitComm::~SplitComm() {
  MPI_Comm handle = comm_.handle();
  MPI_Comm_free(&handle);
}

double Comm::sum(double value) const {
  sum(std::span(&value, 1));
  return value;
}

std::complex<double> Comm::sum(std::complex<double> value) const {
  sum(std::span(&value, 1));
  return value;
}

long Comm::sum(long value) const {
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_LONG, MPI_SUM, handle_));
  return value;
}

double Comm::max(double value) const {
  // MPI_MAX may lose a NaN: it travels as a flag of its own.
  const bool nan = std::isnan(value);
  std::array<double, 2> pair{nan ? -std::numeric_limits<double>::infinity() : value, nan ? 1.0 : 0.0};
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, pair.data(), 2, MPI_DOUBLE, MPI_MAX, handle_));
  return pair[1] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : pair[0];
}

double Comm::min(double value) const { return -max(-value); }

bool Comm::any(bool value) const {
  int flag = value ? 1 : 0;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &flag, 1, MPI_INT, MPI_MAX, handle_));
  return flag != 0;
}

void Comm::sum(std::span<double> values) const {
  if (size_ == 1 || values.empty()) return;
  if (values.size() * size_ <= gather_limit)
    sum_everywhere(handle_, size_, values);
  else
    sum_in_slices(handle_, rank_, size_, values);
}

void Comm::sum(std::span<std::complex<double>> values) const {
  // The standard lays a complex number out as two doubles.
  sum(std::span(reinterpret_cast<double*>(values.data()), 2 * values.size()));
}

void Comm::broadcast(std::span<double> values) const {
  check_mpi(MPI_Bcast(values.data(), mpi_count(values.size()), MPI_DOUBLE, 0, handle_));
}

void Comm::broadcast(double& value) const { broadcast(std::span(&value, 1)); }

std::string Comm::broadcast(const std::string& text) const {
  long length = static_cast<long>(text.size());
  check_mpi(MPI_Bcast(&length, 1, MPI_LONG, 0, handle_));
  std::string received = is_root() ? text : std::string(static_cast<std::size_t>(length), '\0');
  check_mpi(MPI_Bcast(received.data(), mpi_count(received.size()), MPI_CHAR, 0, handle_));
  return received;
}

std::vector<double> Comm::gather(std::span<const double> values) const {
  return gather_on_root(*this, values);
}

std::vector<long> Comm::gather(std::span<const long> values) const { return gather_on_root(*this, values); }

std::vector<long> Comm::all_gather(long value) const {
  std::vector<long> all(size_);
  check_mpi(MPI_Allgather(&value, 1, MPI_LONG, all.data(), 1, MPI_LONG, handle_));
  return all;
}

std::vector<std::vector<int>> Comm::all_to_all(const std::vector<std::vector<int>>& outgoing) const {
  return exchange_all(*this, outgoing);
}

std::vector<std::vector<double>> Comm::all_to_all(const std::vector<std::vector<double>>& outgoing) const {
  return exchange_all(*this, outgoing);
}

void Comm::barrier() const { check_mpi(MPI_Barrier(handle_)); }

}  // namespace wingbeat
