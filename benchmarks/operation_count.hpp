#pragma once

namespace wingbeat::benchmarks {

// Arithmetic of a kernel. Adding and multiplying count one each, fused or not; comparisons and
// selections count as nothing.
struct OperationCount {
  double additions_and_multiplications = 0.0;
  double divisions = 0.0;
  double roots = 0.0;
};

// What one interior cell of the residual costs, counted by running the kernels of the balance on a
// number type that counts.
template <int Dim>
OperationCount residual_operations();

// Values of eight bytes that the sweeps of the balance read and write for a cell: each array once a
// sweep, whatever the caches keep between sweeps.
template <int Dim>
double residual_values();

}  // namespace wingbeat::benchmarks
