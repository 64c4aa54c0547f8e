#include <benchmark/benchmark.h>

#include <complex>
#include <functional>

#include "benchmarks/kernel_table.hpp"
#include "benchmarks/section_flow.hpp"

// CPU time of the kernels on one core. Options of Google Benchmark are understood, as
// --benchmark_filter=residual.
namespace wingbeat::benchmarks {
namespace {

struct Size {
  int around, normal;
  std::string name() const { return std::to_string(around) + "x" + std::to_string(normal); }
};
constexpr Size small{128, 32}, medium{250, 50}, large{512, 128};

// The flow is made when its benchmark runs, so that only what the filter selects is made.
void add(const std::string& kernel, const Comm& comm, Size size, int harmonics,
         const std::function<void(benchmark::State&, SectionFlow&)>& run) {
  std::string name = kernel + "/" + size.name();
  if (harmonics > 0) name += "/N_H=" + std::to_string(harmonics);
  benchmark::RegisterBenchmark(name.c_str(), [=, &comm](benchmark::State& state) {
    SectionFlow flow(comm, size.around, size.normal, harmonics);
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

void add_all(const Comm& comm) {
  for (const Size size : {medium, large}) add("residual", comm, size, 0, residual);
  add("residual", comm, medium, 1, residual);
  add("time derivative", comm, medium, 1, time_derivative);
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
