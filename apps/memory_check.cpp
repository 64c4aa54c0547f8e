#include "apps/memory_check.hpp"

#include <fmt/format.h>

#include "apps/memory_estimate.hpp"
#include "apps/on_root.hpp"
#include "core/io/counted.hpp"
#include "core/io/error.hpp"
#include "core/io/memory.hpp"
#include "core/parallel/rank_texts.hpp"

namespace wingbeat {
namespace {

constexpr double megabyte = 1e6;
// What is asked for may be so many times what there is before it surely does not suffice.
constexpr double doubtful = 1.2;
// OpenBLAS maps a buffer of this size at its first call and, where a limit of address space does not admit
// it, asks for it for ever.
constexpr double blas_buffer = 134.3e6;

// Why memory may not suffice; empty where it does. Throws where it surely does not.
std::string doubt(double asked, double had, const std::string& message) {
  if (asked <= had) return "";
  if (asked <= doubtful * had) return message + "; it may not suffice";
  throw InputError(message +
                   "; run on more nodes, ask for fewer cells or harmonics, or for a method that takes less: "
                   "solver.subdomain = \"ilu\", solver.flow_method = \"runge_kutta\"");
}

}  // namespace

void check_memory(Context& context, std::size_t cells, const PartitionStatistics& partition) {
  const Comm& comm = context.comm;
  return_freed_memory();
  const double held = comm.max(resident_bytes());
  const MemoryEstimate estimate =
      estimate_memory(context.result.command, context.settings, cells, partition, held);
  context.log.line("memory: about {}", memory_text(estimate, comm.size()));
  context.result.findings["memory"]["estimated_megabytes"] = estimate.all_ranks / megabyte;

  const std::string own = on_all(comm, [&] {
    // The ranks of this node may be those of other groups, too.
    const double of_node = context.node_ranks * (estimate.all_ranks / comm.size() - held);
    const double available = available_bytes();
    const std::string node = doubt(
        of_node, available,
        fmt::format("a mesh of {} cells takes about {:.0f} MB on a node of {}, and {:.0f} MB are to be had",
                    cells, of_node / megabyte, counted(context.node_ranks, "rank"), available / megabyte));
    const double of_rank = estimate.largest_rank - held + blas_buffer, allowed = allowed_bytes();
    const std::string limit =
        doubt(of_rank, allowed,
              fmt::format("a mesh of {} cells takes about {:.0f} MB of a rank's address space, and its limit "
                          "(ulimit -v) leaves {:.0f} MB",
                          cells, of_rank / megabyte, allowed / megabyte));
    return node.empty() ? limit : node;
  });
  if (const std::string first = first_line(comm, own); !first.empty()) context.log.warn(first);
}

}  // namespace wingbeat
