#pragma once

#include <mpi.h>

#include <complex>
#include <span>
#include <string>
#include <vector>

namespace wingbeat {

// A group of ranks. Every call is collective over the group unless said otherwise.
// Sums are rank-ordered, so that a repeated run gives identical numbers.
class Comm {
 public:
  explicit Comm(MPI_Comm handle = MPI_COMM_WORLD);

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  MPI_Comm handle() const { return handle_; }

  double sum(double value) const;
  std::complex<double> sum(std::complex<double> value) const;
  long sum(long value) const;
  double max(double value) const;
  double min(double value) const;
  bool any(bool value) const;
  void sum(std::span<double> values) const;
  void sum(std::span<std::complex<double>> values) const;

  void broadcast(std::span<double> values) const;  // from rank 0
  void broadcast(double& value) const;
  std::string broadcast(const std::string& text) const;

  // Values of every rank in rank order, on rank 0 (empty elsewhere) or on all ranks.
  std::vector<double> gather(std::span<const double> values) const;
  std::vector<long> gather(std::span<const long> values) const;
  std::vector<long> all_gather(long value) const;

  // Sends outgoing[rank] to each rank and returns what each rank sent here.
  std::vector<std::vector<int>> all_to_all(const std::vector<std::vector<int>>& outgoing) const;
  std::vector<std::vector<double>> all_to_all(const std::vector<std::vector<double>>& outgoing) const;

  void barrier() const;

 private:
  MPI_Comm handle_;
  int rank_ = 0;
  int size_ = 1;
};

// Ranks of a group, split off: those that name the same color form one, in the group's order.
class SplitComm {
 public:
  SplitComm(const Comm& comm, int color);  // collective
  ~SplitComm();
  SplitComm(const SplitComm&) = delete;
  SplitComm& operator=(const SplitComm&) = delete;
  const Comm& get() const { return comm_; }

 private:
  Comm comm_;
};

// Initialises MPI for the life of the program; BLAS is kept to one thread a rank.
// Catch exceptions within that life: MPI_Finalize waits for the other ranks.
class MpiSession {
 public:
  MpiSession(int& argc, char**& argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
};

}  // namespace wingbeat
