#pragma once

#include <cstddef>
#include <span>

namespace wingbeat {

// A square linear map on distributed vectors: each rank holds local_size() entries.
// apply and apply_transpose are collective; y is overwritten; x and y do not overlap.
// The transpose is the plain one, without conjugation, for complex T too.
template <class T>
class LinearOperator {
 public:
  virtual ~LinearOperator() = default;
  virtual std::size_t local_size() const = 0;
  virtual void apply(std::span<const T> x, std::span<T> y) const = 0;
  virtual void apply_transpose(std::span<const T> x, std::span<T> y) const = 0;
};

// The transpose of an operator, as an operator.
template <class T>
class TransposedOperator final : public LinearOperator<T> {
 public:
  explicit TransposedOperator(const LinearOperator<T>& op) : op_(op) {}
  std::size_t local_size() const override { return op_.local_size(); }
  void apply(std::span<const T> x, std::span<T> y) const override { op_.apply_transpose(x, y); }
  void apply_transpose(std::span<const T> x, std::span<T> y) const override { op_.apply(x, y); }

 private:
  const LinearOperator<T>& op_;
};

template <class T>
class IdentityOperator final : public LinearOperator<T> {
 public:
  explicit IdentityOperator(std::size_t n) : n_(n) {}
  std::size_t local_size() const override { return n_; }
  void apply(std::span<const T> x, std::span<T> y) const override {
    for (std::size_t i = 0; i < n_; ++i) y[i] = x[i];
  }
  void apply_transpose(std::span<const T> x, std::span<T> y) const override { apply(x, y); }

 private:
  std::size_t n_;
};

}  // namespace wingbeat
