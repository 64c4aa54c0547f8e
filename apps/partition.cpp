#include "partition/partition.hpp"

#include <fmt/format.h>

#include "apps/case_mesh.hpp"
#include "apps/flow_setup.hpp"
#include "apps/verbs.hpp"
#include "core/spectral/time_spectral.hpp"

namespace wingbeat {

namespace {

std::string statistics_table(const PartitionStatistics& statistics, std::size_t cells, int instances) {
  return fmt::format("{:<28}{}\n{:<28}{}\n{:<28}{}\n{:<28}{}\n{:<28}{:.3f} %\n{:<28}{}\n{:<28}{}\n{:<28}{}",
                     "ranks", statistics.ranks, "cells", cells, "instances", instances, "blocks",
                     statistics.blocks, "imbalance", 100.0 * statistics.imbalance, "edge cut (cell faces)",
                     statistics.edge_cut, "halo cells", statistics.halo_cells, "halo bytes an exchange",
                     statistics.halo_bytes);
}

}  // namespace

SolveStatus run_partition(Context& context) {
  const int instances = TimeSpectral(context.settings.time.harmonics).instances();
  const AnyMesh mesh = make_case_mesh(context.comm, context.settings.mesh);
  std::visit(
      [&]<int Dim>(const MultiblockMesh<Dim>& built) {
        const PartitionOptions options = partition_options(context.settings);
        const auto partition = partition_mesh(built, context.planned_ranks, options);
        const auto statistics = partition_statistics(built, partition, instances);
        context.log.line(statistics_table(statistics, built.cell_count(), instances));
        context.result.findings["partition"] = {{"ranks", statistics.ranks},
                                                {"cells", built.cell_count()},
                                                {"instances", instances},
                                                {"blocks", statistics.blocks},
                                                {"imbalance", statistics.imbalance},
                                                {"edge_cut", statistics.edge_cut},
                                                {"halo_cells", statistics.halo_cells},
                                                {"halo_bytes", statistics.halo_bytes}};
      },
      mesh);
  return SolveStatus::converged;
}

}  // namespace wingbeat
