#pragma once

#include <complex>
#include <span>
#include <vector>

#include "core/parallel/comm.hpp"

namespace wingbeat {

// Where a ghost entry lives: the owner's rank and its index among the owner's entries.
struct GhostSource {
  int rank = 0;
  int index = 0;
  friend auto operator<=>(const GhostSource&, const GhostSource&) = default;
};

// Fetches copies of entries owned by other ranks, and the exact transpose of that fetch.
// Arrays hold `instances` slices of `width` values an entry: [instance][entry][width].
// All instances of an entry travel in one message a neighbour.
class GhostExchange {
 public:
  GhostExchange() = default;
  // Collective. Ghost g of this rank is a copy of entry sources[g].index of rank sources[g].rank.
  GhostExchange(const Comm& comm, std::span<const GhostSource> sources);

  std::size_t ghost_count() const { return sources_.size(); }
  std::span<const GhostSource> sources() const { return sources_; }

  // ghosts = values of their owners.
  template <class T>
  void gather(std::span<const T> owned, std::span<T> ghosts, int instances, int width) const;
  // owned += sum of the ghost copies of each entry: the transpose of gather.
  template <class T>
  void scatter_add(std::span<const T> ghosts, std::span<T> owned, int instances, int width) const;

 private:
  struct Neighbour {
    int rank = 0;
    std::vector<int> indices;  // ghosts received from, or owned entries sent to, that rank
  };
  void check_sizes(std::size_t owned, std::size_t ghosts, int instances, int width) const;

  std::vector<GhostSource> sources_;
  std::vector<Neighbour> receives_;
  std::vector<Neighbour> sends_;
  int required_entries_ = 0;  // owned entries up to the last one that any rank asks for
  MPI_Comm handle_ = MPI_COMM_SELF;
};

}  // namespace wingbeat
