#include "core/algebra/subdomain_factors.hpp"

#include <complex>
#include <string>
#include <vector>

#include "core/algebra/block_ilu.hpp"
#include "core/algebra/subdomain_data.hpp"
#include "core/algebra/umfpack_lu.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// The rows of a block pattern as rows of single unknowns.
template <class T>
UmfpackLu<T> analyze(const Subdomain::Data& d, int block_size) {
  std::vector<int> row_begin{0}, columns;
  columns.reserve(d.columns.size() * block_size * block_size);
  for (int q = 0; q < d.cell_count; ++q) {
    for (int r = 0; r < block_size; ++r) {
      for (int k = d.row_begin[q]; k < d.row_begin[q + 1]; ++k)
        for (int s = 0; s < block_size; ++s) columns.push_back(d.columns[k] * block_size + s);
      row_begin.push_back(static_cast<int>(columns.size()));
    }
  }
  return UmfpackLu<T>(std::move(row_begin), std::move(columns));
}

template <class T>
class LuFactors final : public SubdomainFactors<T> {
 public:
  LuFactors(const Subdomain::Data& data, int block_size)
      : row_begin_(data.row_begin), block_size_(block_size), lu_(analyze<T>(data, block_size)) {}

  void factor(std::span<const T> blocks) override {
    std::vector<T> values;
    values.reserve(blocks.size());
    for (std::size_t q = 0; q + 1 < row_begin_.size(); ++q)
      for (int r = 0; r < block_size_; ++r)
        for (int k = row_begin_[q]; k < row_begin_[q + 1]; ++k) {
          const auto row = blocks.begin() + (static_cast<std::ptrdiff_t>(k) * block_size_ + r) * block_size_;
          values.insert(values.end(), row, row + block_size_);
        }
    lu_.factor(values);
  }
  void solve(std::span<const T> b, std::span<T> x) const override { lu_.solve(b, x); }
  void solve_transpose(std::span<const T> b, std::span<T> x) const override { lu_.solve_transpose(b, x); }
  double bytes() const override { return lu_.bytes(); }

 private:
  std::vector<int> row_begin_;
  int block_size_;
  UmfpackLu<T> lu_;
};

template <class T, int B>
class IluFactors final : public SubdomainFactors<T> {
 public:
  explicit IluFactors(const Subdomain::Data& data) : ilu_(data.ilu) {}
  void factor(std::span<const T> blocks) override { ilu_.factor(blocks); }
  void solve(std::span<const T> b, std::span<T> x) const override { ilu_.solve(b, x); }
  void solve_transpose(std::span<const T> b, std::span<T> x) const override { ilu_.solve_transpose(b, x); }
  double bytes() const override { return ilu_.bytes(); }

 private:
  BlockIlu<T, B> ilu_;
};

}  // namespace

template <class T>
std::unique_ptr<SubdomainFactors<T>> make_subdomain_factors(const Subdomain& subdomain, int block_size) {
  const Subdomain::Data& data = subdomain.data();
  if (!data.ilu) return std::make_unique<LuFactors<T>>(data, block_size);
  switch (block_size) {
    case 1:
      return std::make_unique<IluFactors<T, 1>>(data);
    case 3:
      return std::make_unique<IluFactors<T, 3>>(data);
    case 4:
      return std::make_unique<IluFactors<T, 4>>(data);
    case 5:
      return std::make_unique<IluFactors<T, 5>>(data);
    default:
      throw InternalError("subdomain factors: no ILU of blocks of " + std::to_string(block_size));
  }
}

template std::unique_ptr<SubdomainFactors<double>> make_subdomain_factors<double>(const Subdomain&, int);
template std::unique_ptr<SubdomainFactors<std::complex<double>>> make_subdomain_factors<std::complex<double>>(
    const Subdomain&, int);

}  // namespace wingbeat
