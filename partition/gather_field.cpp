#include "partition/gather_field.hpp"

#include <algorithm>
#include <string>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// On rank 0: the numbers of the cells of every rank, checked to be each cell of the mesh once.
struct RootNumbering {
  std::vector<long> cells;        // rank after rank
  std::vector<long> rank_counts;  // cells of each rank

  RootNumbering(const Comm& comm, std::span<const long> global_cell)
      : cells(comm.gather(global_cell)), rank_counts(comm.all_gather(static_cast<long>(global_cell.size()))) {
    std::vector<char> seen(cells.size(), 0);
    for (const long cell : cells) {
      ensure(cell >= 0 && static_cast<std::size_t>(cell) < cells.size() && !seen[cell],
             "cell " + std::to_string(cell) + " is outside the mesh or owned twice");
      seen[cell] = 1;
    }
  }
};

}  // namespace

// One instance at a time: rank 0 needs room for the whole field and one instance more.
std::vector<double> gather_to_root(const Comm& comm, std::span<const long> global_cell,
                                   std::span<const double> owned, int instances, int width) {
  const std::size_t slice = global_cell.size() * width;
  ensure(owned.size() == slice * instances, "the field does not match the owned cells");
  const RootNumbering numbering(comm, global_cell);
  const std::size_t whole_slice = numbering.cells.size() * width;
  std::vector<double> whole(whole_slice * instances);
  for (int n = 0; n < instances; ++n) {
    const std::vector<double> parts = comm.gather(owned.subspan(n * slice, slice));
    const double* value = parts.data();
    for (const long cell : numbering.cells) {
      std::copy_n(value, width, whole.data() + n * whole_slice + cell * width);
      value += width;
    }
  }
  return whole;
}

std::vector<double> scatter_from_root(const Comm& comm, std::span<const long> global_cell,
                                      std::span<const double> whole, int instances, int width) {
  const RootNumbering numbering(comm, global_cell);
  const std::size_t whole_slice = numbering.cells.size() * width;
  ensure(!comm.is_root() || whole.size() == whole_slice * instances, "the field does not match the mesh");
  std::vector<double> owned;
  owned.reserve(global_cell.size() * width * instances);
  for (int n = 0; n < instances; ++n) {
    std::vector<std::vector<double>> outgoing(comm.size());
    const long* cell = numbering.cells.data();
    for (int rank = 0; comm.is_root() && rank < comm.size(); ++rank) {
      outgoing[rank].resize(numbering.rank_counts[rank] * width);
      double* value = outgoing[rank].data();
      for (long i = 0; i < numbering.rank_counts[rank]; ++i)
        value = std::copy_n(whole.data() + n * whole_slice + *cell++ * width, width, value);
    }
    const std::vector<double> slice = comm.all_to_all(outgoing)[0];
    owned.insert(owned.end(), slice.begin(), slice.end());
  }
  return owned;
}

}  // namespace wingbeat
