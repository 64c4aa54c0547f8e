#pragma once

#include <memory>
#include <span>

#include "core/algebra/schwarz.hpp"

namespace wingbeat {

// Factors, exact or not, of a matrix restricted to a subdomain. Vectors hold the subdomain's cells
// in elimination order, B values each. T is double or std::complex<double>.
template <class T>
class SubdomainFactors {
 public:
  virtual ~SubdomainFactors() = default;
  // Factors the matrix of these B x B blocks, row-major, one an entry of the subdomain's pattern.
  // Throws InternalError where that is not possible.
  virtual void factor(std::span<const T> blocks) = 0;
  // x = M b and x = M^T b (no conjugation), M being the inverse or what stands for it.
  virtual void solve(std::span<const T> b, std::span<T> x) const = 0;
  virtual void solve_transpose(std::span<const T> b, std::span<T> x) const = 0;
  virtual double bytes() const = 0;
};

// By the subdomain's method; B is 1, 3, 4 or 5.
template <class T>
std::unique_ptr<SubdomainFactors<T>> make_subdomain_factors(const Subdomain& subdomain, int block_size);

}  // namespace wingbeat
