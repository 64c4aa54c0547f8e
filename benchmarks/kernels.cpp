#include <benchmark/benchmark.h>

#include <complex>
#include <functional>

#include "benchmarks/kernel_table.hpp"
#include "benchmarks/section_flow.hpp"
#include "flow/multigrid.hpp"
#include "flow/spectral_radius.hpp"

// CPU time of the kernels on one core. Options of Google Benchmark are understood, as
// --benchmark_filter=residual.
namespace wingbeat::benchmarks {
namespace {

struct Size {
  int around, normal;
  std::string name() const { return std::to_string(around) + "x" + std::to_string(normal); }
};
constexpr Size tiny{16, 4}, block{16, 16}, square{64, 64};  // what many ranks leave each
constexpr Size small{128, 32}, medium{250, 50}, halved{256, 64}, large{512, 128};

// The flow is made when its benchmark runs, so that only what the filter selects is made.
void add(const std::string& kernel, const Comm& comm, Size size, int harmonics,
         const std::function<void(benchmark::State&, SectionFlow&)>& run,
         const Scheme& scheme = JstScheme{}) {
  std::string name = kernel + "/" + size.name();
  if (harmonics > 0) name += "/N_H=" + std::to_string(harmonics);
  benchmark::RegisterBenchmark(name.c_str(), [=, &comm](benchmark::State& state) {
    SectionFlow flow(comm, size.around, size.normal, harmonics, scheme);
    state.counters["cells"] = flow.cell_count() * static_cast<double>(flow.equations.instance_count());
    run(state, flow);
  })->Repetitions(5);
}

void residual(benchmark::State& state, SectionFlow& flow) {
  std::vector<double> r(flow.w.size());
  for (auto _ : state) flow.residual(r);
}

void time_derivative(benchmark::State& state, SectionFlow& flow) {
  std::vector<double> r(flow.w.size());
  for (auto _ : state) flow.equations.add_time_derivative(1e-9, flow.w, r);
}

void jacobian(benchmark::State& state, SectionFlow& flow) {
  flow.linearize();
  for (auto _ : state) flow.linearize();
}

// Bytes of the products: the blocks and their columns once, x once, y read and written.
double product_bytes(const SectionFlow& flow) {
  const auto& matrix = flow.equations.jacobians().front();
  const auto blocks = static_cast<double>(matrix.pattern().block_count());
  const double a_matrix = static_cast<double>(matrix.values().size_bytes()) + 4.0 * blocks;
  return static_cast<double>(flow.equations.instance_count()) * a_matrix +
         3.0 * 8.0 * static_cast<double>(flow.w.size());
}

void product(benchmark::State& state, SectionFlow& flow) {
  flow.linearize();
  std::vector<double> y(flow.w.size());
  state.counters["bytes"] = product_bytes(flow);
  for (auto _ : state) flow.equations.apply(flow.w, y);
}

void transposed_product(benchmark::State& state, SectionFlow& flow) {
  flow.linearize();
  std::vector<double> y(flow.w.size());
  state.counters["bytes"] = product_bytes(flow);
  for (auto _ : state) flow.equations.apply_transpose(flow.w, y);
}

// The Jacobian with a pseudo-time term; in the complex case, that of the first harmonic.
template <class T>
struct Factors {
  std::vector<T> shift;
  SchwarzSolver<T> solver;
  explicit Factors(SectionFlow& flow) : solver(flow.level.comm(), flow.level.subdomain, state_size<2>) {
    flow.linearize();
    T rate(flow.kappa);
    if constexpr (!std::is_same_v<T, double>) rate = T(0.0, flow.kappa);
    for (double volume : flow.level.domain.volumes()) shift.push_back(rate * volume);
  }
  void factor(const SectionFlow& flow) {
    solver.template factor<state_size<2>>(flow.equations.jacobians().front(), shift);
  }
};

template <class T>
void factorization(benchmark::State& state, SectionFlow& flow) {
  Factors<T> factors(flow);
  factors.factor(flow);  // analyses the pattern
  for (auto _ : state) factors.factor(flow);
}

template <class T>
void solve(benchmark::State& state, SectionFlow& flow) {
  Factors<T> factors(flow);
  factors.factor(flow);
  const std::vector<T> b(flow.level.domain.state_count(), T(1.0));
  std::vector<T> x(b.size());
  state.counters["bytes"] = factors.solver.factor_bytes();
  for (auto _ : state) factors.solver.apply(b, x);
}

// A stage's share of a whole step, time steps and coefficients of the smoothing included.
void runge_kutta_stage(benchmark::State& state, SectionFlow& flow) {
  RungeKutta<2> smoother(flow.equations);
  const std::vector<double> start = flow.w;
  state.counters["cells"].value *= 5.0;
  for (auto _ : state) {
    flow.w = start;
    smoother.step(flow.w, flow.motions, flow.kappa, {}, {});
  }
}

void residual_smoothing(benchmark::State& state, SectionFlow& flow) {
  const int instances = static_cast<int>(flow.equations.instance_count());
  ResidualSmoothing<2> smoothing(flow.level.domain);
  smoothing.set_coefficients(
      directional_radii<2>(flow.level.domain,
                           std::span<const double>(flow.w).first(flow.level.domain.state_count()),
                           flow.motions.front(), flow.equations.model().freestream.gamma),
      1, RungeKuttaOptions{}.smoothing);
  for (auto _ : state) smoothing.apply(flow.w, instances);
}

// To the next coarser mesh and back, as a cycle does once on each mesh.
void grid_transfers(benchmark::State& state, SectionFlow& flow) {
  const int instances = static_cast<int>(flow.equations.instance_count());
  CoarseLevel<2> coarse(coarsened<2>(flow.level.mesh, flow.level.partition).value(), flow.equations.model(),
                        flow.equations.time(), flow.level.domain);
  std::vector<double> r(flow.w.size());
  for (auto _ : state) {
    coarse.transfer.restrict_mean(flow.w, coarse.w, instances);
    coarse.transfer.restrict_sum(r, coarse.restricted, instances);
    coarse.transfer.prolong_add(coarse.source, flow.w, instances);
  }
}

void w_cycle(benchmark::State& state, SectionFlow& flow) {
  const MultigridOptions options;
  Multigrid<2> multigrid(flow.equations, {flow.level.mesh, flow.level.partition}, options);
  const std::vector<double> start = flow.w;
  for (auto _ : state) {
    flow.w = start;
    multigrid.cycle(flow.w, flow.motions, flow.kappa, options.runge_kutta);
  }
}

void add_all(const Comm& comm) {
  for (const Size size : {medium, large}) add("residual", comm, size, 0, residual);
  add("residual", comm, medium, 1, residual);
  add("residual, matrix", comm, medium, 0, residual, MatrixScheme{});
  add("residual, CUSP", comm, medium, 0, residual, CuspScheme{});
  add("residual, Roe", comm, medium, 0, residual, RoeScheme{});
  add("residual, van Leer", comm, medium, 0, residual, VanLeerScheme{});
  add("time derivative", comm, medium, 1, time_derivative);
  for (const int harmonics : {0, 1, 3}) {
    add("Runge-Kutta stage", comm, halved, harmonics, runge_kutta_stage);
    add("W cycle", comm, halved, harmonics, w_cycle);
  }
  for (const Size size : {tiny, block, square}) add("Runge-Kutta stage", comm, size, 3, runge_kutta_stage);
  add("Runge-Kutta stage", comm, large, 0, runge_kutta_stage);
  add("W cycle", comm, large, 3, w_cycle);
  add("W cycle", comm, large, 0, w_cycle);
  add("residual smoothing", comm, halved, 0, residual_smoothing);
  add("grid transfers", comm, halved, 0, grid_transfers);
  for (const Size size : {medium, large}) {
    add("jacobian", comm, size, 0, jacobian);
    add("product", comm, size, 0, product);
    add("transposed product", comm, size, 0, transposed_product);
  }
  add("product", comm, medium, 1, product);
  for (const Size size : {small, medium}) {
    add("LU factor, real", comm, size, 0, factorization<double>);
    add("LU factor, complex", comm, size, 0, factorization<std::complex<double>>);
    add("LU solve, real", comm, size, 0, solve<double>);
    add("LU solve, complex", comm, size, 0, solve<std::complex<double>>);
  }
}

}  // namespace
}  // namespace wingbeat::benchmarks

int main(int argc, char** argv) {
  using namespace wingbeat;
  using namespace wingbeat::benchmarks;
  const MpiSession session(argc, argv);
  const Comm comm;
  benchmark::Initialize(&argc, argv);
  add_all(comm);
  KernelTable table;
  benchmark::RunSpecifiedBenchmarks(&table);
  // The triad goes through as much memory as the residual's arrays hold at 250 x 50.
  table.print(measure_machine(std::size_t{2} << 20));
}
