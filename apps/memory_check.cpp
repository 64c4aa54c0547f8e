#include "apps/memory_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/memory_estimate.hpp"
#include "core/io/error.hpp"
#include "core/io/memory.hpp"

namespace wingbeat {
namespace {

constexpr double megabyte = 1e6;
constexpr double error = 0.2;  // of an estimate

}  // namespace

void check_memory(Context& context, std::size_t cells, const PartitionStatistics& partition, double process) {
  const Comm& comm = context.comm;
  process = comm.max(process);
  const MemoryEstimate estimate =
      estimate_memory(context.result.command, context.settings, cells, partition, process);
  context.log.line("memory: about {}", memory_text(estimate, comm.size()));
  context.result.findings["memory"]["estimated_megabytes"] = estimate.all_ranks / megabyte;

  // What is yet to be taken by the ranks of this node, which may be those of other groups, too.
  const double by_rank = estimate.all_ranks / comm.size() - process;
  const double needed = context.node_ranks * by_rank, had = available_bytes();
  const double limited = estimate.largest_rank - process, allowed = allowed_bytes();
  const double share = comm.max(std::max(needed / had, limited / allowed));
  if (share <= 1.0) return;
  const std::string message = fmt::format(
      "a mesh of {} cells takes about {:.0f} MB on a node of {} rank{}, and {:.0f} MB are to be had", cells,
      needed / megabyte, context.node_ranks, context.node_ranks == 1 ? "" : "s",
      std::min(had, context.node_ranks * allowed) / megabyte);
  if (share <= 1.0 / (1.0 - error)) {
    context.log.warn(message + "; it may not suffice");
    return;
  }
  throw InputError(message +
                   "; run on more nodes, ask for fewer cells or harmonics, or for a method that takes less: "
                   "solver.subdomain = \"ilu\", solver.flow_method = \"runge_kutta\"");
}

}  // namespace wingbeat
