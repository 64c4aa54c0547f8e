#include "apps/memory_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wingbeat {
namespace {

// Fitted to the peaks of whole runs (docs/performance.md, memory). Of a rank beside its cells:
constexpr double program_bytes = 4e6;
// Of a cell:
constexpr double flow_bytes = 2850.0;      // geometry and state on all levels, the Jacobian of one instance
constexpr double instance_bytes = 2850.0;  // each further one
constexpr double matrix_bytes = 5000.0;    // of a matrix on its way to exact factors
constexpr double complex_matrix_bytes = 3000.0;  // more of a complex one
constexpr double cycle_bytes = 3150.0;           // of Runge-Kutta cycles on all levels
constexpr double cycle_instance_bytes = 250.0;
constexpr double state_bytes = 500.0;  // of a level on which nothing is solved yet
constexpr double vector_bytes = 32.0;  // of one instance
constexpr double mesh_bytes = 200.0;   // where nothing but the mesh is made and written

// The linear start of turns is made on a mesh of a quarter of the cells.
constexpr double coarsening = 4.0;

// Cells of a rank: its own, and those of the matrix that it factors, overlap included.
struct RankCells {
  double own = 0.0, factored = 0.0;
};

// What is held of a period beside the steady flow.
struct Period {
  int instances = 1;  // with their Jacobians
  int harmonics = 0;  // with their factors
};

Period period(int harmonics) { return {2 * harmonics + 1, harmonics}; }

Period period_of(const std::string& verb, const CaseSettings& settings) {
  const int harmonics = settings.time.harmonics;
  if (verb == "steady" || verb == "march") return period(0);
  if (verb == "gradient" && settings.gradient.is_of_loads() && settings.gradient.analysis == "steady")
    return period(0);
  if (verb == "pk") return period(settings.pk.aerodynamics == "forced" ? std::max(2, harmonics) : 1);
  return period(harmonics);
}

// Krylov vectors that are likely at the same time: a linear solve takes a dozen with exact factors.
double krylov_vectors(const SolverSettings& solver, const std::string& verb) {
  const bool takes_long = solver.subdomain == "ilu" || verb == "lco";
  return std::min<double>(solver.krylov_restart, takes_long ? 50.0 : 12.0);
}

// The factors of a cell on all levels and, where they are exact, what making them takes. Complex ones are
// twice the real. Those of LU by nested dissection grow as the logarithm of the cells (George 1973,
// doi:10.1137/0710032), those of ILU(k) do not; coarser meshes keep half as much as the finest.
double factor_bytes(const SolverSettings& solver, double cells, int harmonics) {
  if (solver.subdomain == "ilu") return (1.0 + 2.0 * harmonics) * (1150.0 + 800.0 * solver.ilu_fill);
  const double real = std::max(4000.0, 12800.0 + 1500.0 * (std::log2(cells) - 12.0));
  return (1.5 + 2.0 * harmonics) * real + matrix_bytes + (harmonics > 0 ? complex_matrix_bytes : 0.0);
}

double by_newton(const SolverSettings& solver, const RankCells& cells, const Period& period, double vectors) {
  const double own =
      flow_bytes + (period.instances - 1) * instance_bytes + 2.0 * vectors * period.instances * vector_bytes;
  return cells.own * own + cells.factored * factor_bytes(solver, cells.factored, period.harmonics);
}

double by_cycles(const RankCells& cells, const Period& period) {
  return cells.own * (cycle_bytes + period.instances * cycle_instance_bytes);
}

double bytes_of(const std::string& verb, const CaseSettings& settings, const RankCells& cells) {
  if (verb == "mesh" || verb == "partition") return cells.own * mesh_bytes;
  if (verb == "sweep") return bytes_of(settings.sweep.verb, settings, cells);
  if (verb == "optimize") {
    // What the designs need stays while the optimum is compared with the baseline.
    double most = 0.0;
    for (const std::string& compared : settings.optimize.compare)
      most = std::max(most, bytes_of(compared, settings, cells));
    return bytes_of("flutter", settings, cells) + most;
  }
  const SolverSettings& solver = settings.solver;
  const Period held = period_of(verb, settings);
  const double newton = by_newton(solver, cells, held, krylov_vectors(solver, verb));
  const double cycles = by_cycles(cells, held);
  if (verb == "steady" || verb == "march" || verb == "pitch") {
    if (!solver.uses_cycles()) return newton;
    return solver.ends_with_newton() ? std::max(cycles, newton) : cycles;
  }
  if (!solver.is_staggered() || (verb != "flutter" && verb != "lco")) return newton;
  const RankCells coarse{cells.own / coarsening, cells.factored / coarsening};
  const double start =
      cells.own * state_bytes + by_newton(solver, coarse, period(1), krylov_vectors(solver, "flutter"));
  return std::max(start, solver.ends_with_newton() ? newton : cycles);
}

}  // namespace

MemoryEstimate estimate_memory(const std::string& verb, const CaseSettings& settings, std::size_t cells,
                               const PartitionStatistics& partition, double process) {
  // The statistics count two layers of halo cells.
  const double ranks = partition.ranks, mean = static_cast<double>(cells) / ranks;
  const double overlap = 0.5 * settings.solver.overlap * static_cast<double>(partition.halo_cells) / ranks;
  const auto of_rank = [&](double own) {
    const double factored = std::min(own + overlap, static_cast<double>(cells));
    return process + program_bytes + bytes_of(verb, settings, {own, factored});
  };
  return {of_rank((1.0 + partition.imbalance) * mean), ranks * of_rank(mean)};
}

std::string memory_text(const MemoryEstimate& estimate, int ranks) {
  constexpr double megabyte = 1e6;
  const std::string all = fmt::format("{:.0f} MB", estimate.all_ranks / megabyte);
  if (ranks == 1) return all;
  return fmt::format("{} on {} ranks, {:.0f} MB on the largest", all, ranks,
                     estimate.largest_rank / megabyte);
}

}  // namespace wingbeat
