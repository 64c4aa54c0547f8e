#include "core/parallel/comm.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/io/error.hpp"
#include "core/parallel/mpi_call.hpp"

namespace wingbeat {
namespace {

// Values whose sum depends on the order of the additions.
double rough(int rank, std::size_t i) {
  return std::ldexp(1.0 + 0.1 * rank, 40 * ((rank + static_cast<int>(i % 7)) % 3)) * (rank % 2 ? -1.0 : 1.0);
}

double sum_in_rank_order(int size, std::size_t i) {
  double sum = rough(0, i);
  for (int rank = 1; rank < size; ++rank) sum += rough(rank, i);
  return sum;
}

TEST(Comm, MpiIsTheRealLibrary) {
  void* symbol = dlsym(RTLD_DEFAULT, "MPI_Init");
  ASSERT_NE(symbol, nullptr);
  Dl_info info{};
  ASSERT_NE(dladdr(symbol, &info), 0);
  EXPECT_NE(std::string(info.dli_fname).find("/libmpi.so"), std::string::npos) << info.dli_fname;
}

TEST(Comm, ScalarSumsAreRankOrdered) {
  const Comm comm;
  EXPECT_EQ(comm.sum(rough(comm.rank(), 0)), sum_in_rank_order(comm.size(), 0));
  const std::complex<double> z = comm.sum(std::complex(rough(comm.rank(), 1), rough(comm.rank(), 2)));
  EXPECT_EQ(z, std::complex(sum_in_rank_order(comm.size(), 1), sum_in_rank_order(comm.size(), 2)));
  const long size = comm.size();
  EXPECT_EQ(comm.sum((1L << 53) + comm.rank()), size * (1L << 53) + size * (size - 1) / 2);
}

// Lengths on both sides of the change of algorithm, and shorter than the number of ranks.
TEST(Comm, SpanSumsAreRankOrderedForAnyLength) {
  const Comm comm;
  for (const std::size_t n : {0, 1, 3, 100, 5000, 20001}) {
    std::vector<double> values(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = rough(comm.rank(), i);
    comm.sum(std::span(values));
    for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(values[i], sum_in_rank_order(comm.size(), i)) << i;
  }
  std::vector<std::complex<double>> values(9001);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = {rough(comm.rank(), i), 1.0};
  comm.sum(std::span(values));
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_EQ(values[i], std::complex(sum_in_rank_order(comm.size(), i), 1.0 * comm.size()));
}

TEST(Comm, ExtremesKeepNotANumber) {
  const Comm comm;
  const int last = comm.size() - 1;
  EXPECT_EQ(comm.max(-1.0 - comm.rank()), -1.0);
  EXPECT_EQ(comm.min(-1.0 - comm.rank()), -1.0 - last);
  const double poisoned = comm.rank() == last ? std::numeric_limits<double>::quiet_NaN() : 1.0;
  EXPECT_TRUE(std::isnan(comm.max(poisoned)));
  EXPECT_TRUE(std::isnan(comm.min(poisoned)));
  EXPECT_TRUE(comm.any(comm.rank() == last));
  EXPECT_FALSE(comm.any(false));
}

TEST(Comm, BroadcastsComeFromTheRoot) {
  const Comm comm;
  std::vector<double> values(3, comm.rank() + 0.5);
  comm.broadcast(std::span(values));
  EXPECT_EQ(values, std::vector<double>(3, 0.5));
  double value = comm.rank();
  comm.broadcast(value);
  EXPECT_EQ(value, 0.0);
  EXPECT_EQ(comm.broadcast(comm.is_root() ? "flutter" : "another, longer text"), "flutter");
  EXPECT_EQ(comm.broadcast(comm.is_root() ? "" : "text"), "");
}

TEST(Comm, GathersInRankOrderWithEmptyParts) {
  const Comm comm;
  std::vector<double> own(comm.rank() % 2 == 1 ? 0 : comm.rank() + 1, comm.rank());
  std::vector<double> expected;
  if (comm.is_root())
    for (int rank = 0; rank < comm.size(); rank += 2) expected.insert(expected.end(), rank + 1, rank);
  EXPECT_EQ(comm.gather(own), expected);

  const std::vector<long> squares = comm.all_gather(long{comm.rank()} * comm.rank());
  ASSERT_EQ(squares.size(), static_cast<std::size_t>(comm.size()));
  for (int rank = 0; rank < comm.size(); ++rank) EXPECT_EQ(squares[rank], long{rank} * rank);
}

// Rank r sends s values 100 r + s to rank s (none to rank 0).
template <class T>
void check_all_to_all(const Comm& comm) {
  std::vector<std::vector<T>> outgoing(comm.size());
  for (int to = 0; to < comm.size(); ++to) outgoing[to].assign(to, T(100 * comm.rank() + to));
  const auto incoming = comm.all_to_all(outgoing);
  ASSERT_EQ(incoming.size(), static_cast<std::size_t>(comm.size()));
  for (int from = 0; from < comm.size(); ++from)
    EXPECT_EQ(incoming[from], std::vector<T>(comm.rank(), T(100 * from + comm.rank())));
}

TEST(Comm, AllToAllDeliversUnequalLengths) {
  check_all_to_all<int>(Comm());
  check_all_to_all<double>(Comm());
}

TEST(Comm, FailuresNameRankAndPlace) {
  const Comm comm;
  try {
    check_mpi(MPI_Send(nullptr, -1, MPI_DOUBLE, comm.rank(), 0, comm.handle()));
    FAIL() << "a negative count was accepted";
  } catch (const InternalError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("rank " + std::to_string(comm.rank())), std::string::npos) << message;
    EXPECT_NE(message.find("comm_test.cpp"), std::string::npos) << message;
    EXPECT_NE(message.find("MPI_ERR_COUNT"), std::string::npos) << message;
  }
  EXPECT_THROW(mpi_count(std::size_t{1} << 31), InternalError);
}

}  // namespace
}  // namespace wingbeat
