#include "core/parallel/ghost_exchange.hpp"

#include <algorithm>
#include <memory>
#include <string>

#include "core/io/error.hpp"
#include "core/parallel/mpi_call.hpp"

namespace wingbeat {
namespace {

constexpr int halo_tag = 2;

// Where the values of entry indices[i], instance n start in an array [instance][entry][width],
// and in a message [i][instance][width].
struct Layout {
  std::size_t entries;
  int instances;
  int width;

  std::size_t entry_size() const { return static_cast<std::size_t>(instances) * width; }
  std::size_t position(int entry, int instance) const { return (instance * entries + entry) * width; }
};

template <class T>
void pack(std::span<const int> indices, std::span<const T> values, const Layout& layout, T* message) {
  for (const int entry : indices)
    for (int n = 0; n < layout.instances; ++n)
      message = std::copy_n(values.data() + layout.position(entry, n), layout.width, message);
}

template <class T>
void unpack(const T* message, std::span<const int> indices, const Layout& layout, std::span<T> values) {
  for (const int entry : indices)
    for (int n = 0; n < layout.instances; ++n, message += layout.width)
      std::copy_n(message, layout.width, values.data() + layout.position(entry, n));
}

template <class T>
void unpack_add(const T* message, std::span<const int> indices, const Layout& layout, std::span<T> values) {
  for (const int entry : indices)
    for (int n = 0; n < layout.instances; ++n, message += layout.width)
      for (int v = 0; v < layout.width; ++v) values[layout.position(entry, n) + v] += message[v];
}

// One message to and from each neighbour: pack(neighbour, message) fills those sent,
// unpack(neighbour, message) empties those received, in the order of the ranks.
template <class T, class Neighbours, class Pack, class Unpack>
void exchange(MPI_Comm comm, const Neighbours& sends, const Neighbours& receives, std::size_t entry_size,
              Pack&& pack_message, Unpack&& unpack_message) {
  const auto length = [&](const auto& neighbour) { return neighbour.indices.size() * entry_size; };
  std::size_t total = 0;
  for (const auto& neighbour : sends) total += length(neighbour);
  for (const auto& neighbour : receives) total += length(neighbour);
  const auto buffer = std::make_unique_for_overwrite<T[]>(total);
  int own = 0;
  check_mpi(MPI_Comm_rank(comm, &own));

  T* position = buffer.get();
  const T* own_message = nullptr;
  std::vector<MPI_Request> requests;
  requests.reserve(sends.size() + receives.size());
  T* const received = position;
  for (const auto& neighbour : receives) {
    if (neighbour.rank != own)
      check_mpi(MPI_Irecv(position, mpi_count(length(neighbour)), mpi_type<T>(), neighbour.rank, halo_tag,
                          comm, &requests.emplace_back()));
    position += length(neighbour);
  }
  for (const auto& neighbour : sends) {
    pack_message(neighbour, position);
    if (neighbour.rank != own)
      check_mpi(MPI_Isend(position, mpi_count(length(neighbour)), mpi_type<T>(), neighbour.rank, halo_tag,
                          comm, &requests.emplace_back()));
    else
      own_message = position;
    position += length(neighbour);
  }
  check_mpi(MPI_Waitall(mpi_count(requests.size()), requests.data(), MPI_STATUSES_IGNORE));

  const T* message = received;
  for (const auto& neighbour : receives) {
    unpack_message(neighbour, neighbour.rank == own ? own_message : message);
    message += length(neighbour);
  }
}

std::string size_message(const char* what, std::size_t size, std::size_t expected) {
  return std::string(what) + " holds " + std::to_string(size) + " values instead of " +
         std::to_string(expected);
}

}  // namespace

GhostExchange::GhostExchange(const Comm& comm, std::span<const GhostSource> sources)
    : sources_(sources.begin(), sources.end()), handle_(comm.handle()) {
  std::vector<std::vector<int>> ghosts_of(comm.size()), wanted(comm.size());
  for (std::size_t g = 0; g < sources_.size(); ++g) {
    const auto [rank, index] = sources_[g];
    ensure(rank >= 0 && rank < comm.size() && index >= 0,
           "ghost " + std::to_string(g) + " names entry " + std::to_string(index) + " of rank " +
               std::to_string(rank) + " of " + std::to_string(comm.size()));
    ghosts_of[rank].push_back(static_cast<int>(g));
    wanted[rank].push_back(index);
  }
  std::vector<std::vector<int>> requested = comm.all_to_all(wanted);
  for (int rank = 0; rank < comm.size(); ++rank) {
    for (const int index : requested[rank]) required_entries_ = std::max(required_entries_, index + 1);
    if (!ghosts_of[rank].empty()) receives_.push_back({rank, std::move(ghosts_of[rank])});
    if (!requested[rank].empty()) sends_.push_back({rank, std::move(requested[rank])});
  }
}

void GhostExchange::check_sizes(std::size_t owned, std::size_t ghosts, int instances, int width) const {
  ensure(instances > 0 && width > 0, "an exchange needs at least one instance and one value an entry");
  const std::size_t entry_size = static_cast<std::size_t>(instances) * width;
  ensure(ghosts == ghost_count() * entry_size, size_message("ghosts", ghosts, ghost_count() * entry_size));
  ensure(owned % entry_size == 0 && owned / entry_size >= static_cast<std::size_t>(required_entries_),
         "owned holds " + std::to_string(owned) + " values; the neighbours ask for " +
             std::to_string(required_entries_) + " entries of " + std::to_string(entry_size));
}

template <class T>
void GhostExchange::gather(std::span<const T> owned, std::span<T> ghosts, int instances, int width) const {
  check_sizes(owned.size(), ghosts.size(), instances, width);
  const std::size_t entry_size = static_cast<std::size_t>(instances) * width;
  const Layout from{owned.size() / entry_size, instances, width};
  const Layout to{ghost_count(), instances, width};
  exchange<T>(
      handle_, sends_, receives_, entry_size,
      [&](const Neighbour& neighbour, T* message) { pack<T>(neighbour.indices, owned, from, message); },
      [&](const Neighbour& neighbour, const T* message) {
        unpack<T>(message, neighbour.indices, to, ghosts);
      });
}

template <class T>
void GhostExchange::scatter_add(std::span<const T> ghosts, std::span<T> owned, int instances,
                                int width) const {
  check_sizes(owned.size(), ghosts.size(), instances, width);
  const std::size_t entry_size = static_cast<std::size_t>(instances) * width;
  const Layout from{ghost_count(), instances, width};
  const Layout to{owned.size() / entry_size, instances, width};
  exchange<T>(
      handle_, receives_, sends_, entry_size,
      [&](const Neighbour& neighbour, T* message) { pack<T>(neighbour.indices, ghosts, from, message); },
      [&](const Neighbour& neighbour, const T* message) {
        unpack_add<T>(message, neighbour.indices, to, owned);
      });
}

template void GhostExchange::gather(std::span<const double>, std::span<double>, int, int) const;
template void GhostExchange::gather(std::span<const std::complex<double>>, std::span<std::complex<double>>,
                                    int, int) const;
template void GhostExchange::gather(std::span<const int>, std::span<int>, int, int) const;
template void GhostExchange::scatter_add(std::span<const double>, std::span<double>, int, int) const;
template void GhostExchange::scatter_add(std::span<const std::complex<double>>,
                                         std::span<std::complex<double>>, int, int) const;
template void GhostExchange::scatter_add(std::span<const int>, std::span<int>, int, int) const;

}  // namespace wingbeat
