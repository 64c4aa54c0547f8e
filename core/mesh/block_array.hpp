#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <vector>

namespace wingbeat {

template <int Dim>
using Index = std::array<int, Dim>;

// Half-open box of indices: begin[d] <= index[d] < end[d].
template <int Dim>
struct Box {
  Index<Dim> begin{};
  Index<Dim> end{};

  int extent(int d) const { return end[d] - begin[d]; }
  std::size_t size() const {
    std::size_t n = 1;
    for (int d = 0; d < Dim; ++d) n *= static_cast<std::size_t>(extent(d) > 0 ? extent(d) : 0);
    return n;
  }
  bool contains(const Index<Dim>& index) const {
    for (int d = 0; d < Dim; ++d)
      if (index[d] < begin[d] || index[d] >= end[d]) return false;
    return true;
  }
  friend bool operator==(const Box&, const Box&) = default;
};

template <int Dim>
Box<Dim> box_of(const Index<Dim>& extents) {
  return {Index<Dim>{}, extents};
}

template <int Dim>
Box<Dim> grown(Box<Dim> box, int layers) {
  for (int d = 0; d < Dim; ++d) box.begin[d] -= layers, box.end[d] += layers;
  return box;
}

// Calls f(index) for every index of the box, the first index fastest.
template <int Dim, class F>
void for_each(const Box<Dim>& box, F&& f) {
  if (box.size() == 0) return;
  Index<Dim> index = box.begin;
  while (true) {
    f(index);
    int d = 0;
    while (d < Dim && ++index[d] == box.end[d]) index[d] = box.begin[d], ++d;
    if (d == Dim) return;
  }
}

// Array over a box of indices and its halo, the first index fastest.
// Valid indices run from -halo to extent + halo - 1 in every direction.
template <class T, int Dim>
class BlockArray {
 public:
  BlockArray() = default;
  BlockArray(const Index<Dim>& extents, int halo, const T& value = T{})
      : extents_(extents), halo_(halo), values_(grown(box_of<Dim>(extents), halo).size(), value) {
    std::ptrdiff_t step = 1;
    for (int d = 0; d < Dim; ++d) {
      strides_[d] = step;
      origin_ += halo * step;
      step *= extents[d] + 2 * halo;
    }
  }

  T& operator()(const Index<Dim>& index) { return values_[offset(index)]; }
  const T& operator()(const Index<Dim>& index) const { return values_[offset(index)]; }

  // Position of an index in data(); neighbours differ by stride(direction).
  std::size_t offset(const Index<Dim>& index) const {
    std::ptrdiff_t position = origin_;
    for (int d = 0; d < Dim; ++d) {
      assert(index[d] >= -halo_ && index[d] < extents_[d] + halo_);
      position += index[d] * strides_[d];
    }
    return static_cast<std::size_t>(position);
  }
  std::ptrdiff_t stride(int direction) const { return strides_[direction]; }

  const Index<Dim>& extents() const { return extents_; }
  int halo() const { return halo_; }
  Box<Dim> interior() const { return box_of<Dim>(extents_); }
  std::size_t size() const { return values_.size(); }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }

 private:
  Index<Dim> extents_{};
  int halo_ = 0;
  std::array<std::ptrdiff_t, Dim> strides_{};
  std::ptrdiff_t origin_ = 0;
  std::vector<T> values_;
};

}  // namespace wingbeat
