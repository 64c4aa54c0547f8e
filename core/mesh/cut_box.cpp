#include "core/mesh/cut_box.hpp"

#include <algorithm>
#include <climits>
#include <string>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

template <int Dim>
void cut_recursively(const Box<Dim>& box, int count, int minimum_width, std::vector<Box<Dim>>& boxes) {
  if (count == 1) {
    boxes.push_back(box);
    return;
  }
  int direction = 0;
  for (int d = 1; d < Dim; ++d)
    if (box.extent(d) > box.extent(direction)) direction = d;
  for (int d = Dim - 1; d >= 0; --d)
    if (box.extent(d) >= count * minimum_width) direction = d;

  // Each part must be wide enough for its pieces, `per_layer` of them side by side; where both
  // do not fit, the first takes whole layers.
  const int width = box.extent(direction);
  const auto layers = static_cast<std::size_t>(std::max(1, width / minimum_width));
  const int per_layer =
      static_cast<int>(std::min<std::size_t>(cut_capacity(box, minimum_width) / layers, INT_MAX));
  const auto width_for = [&](int pieces) { return ((pieces - 1) / per_layer + 1) * minimum_width; };
  int low_count = count / 2;
  if (width_for(low_count) + width_for(count - low_count) > width) low_count -= low_count % per_layer;
  const int even = static_cast<int>((2L * width * low_count + count) / (2L * count));
  const int position = std::clamp(even, width_for(low_count), width - width_for(count - low_count));

  Box<Dim> low = box, high = box;
  low.end[direction] = high.begin[direction] = box.begin[direction] + position;
  cut_recursively(low, low_count, minimum_width, boxes);
  cut_recursively(high, count - low_count, minimum_width, boxes);
}

}  // namespace

template <int Dim>
std::size_t cut_capacity(const Box<Dim>& box, int minimum_width) {
  std::size_t pieces = 1;
  for (int d = 0; d < Dim; ++d)
    pieces *= static_cast<std::size_t>(std::max(1, box.extent(d) / std::max(1, minimum_width)));
  return pieces;
}

template <int Dim>
std::vector<Box<Dim>> cut_box(const Box<Dim>& box, int count, int minimum_width) {
  ensure(count >= 1 && minimum_width >= 1, "cut_box needs a positive count and width");
  if (static_cast<std::size_t>(count) > cut_capacity(box, minimum_width))
    throw InputError("a block of " + std::to_string(box.size()) + " cells cannot be cut into " +
                     std::to_string(count) + " pieces at least " + std::to_string(minimum_width) +
                     " cells wide; ask for fewer blocks or a finer mesh");
  std::vector<Box<Dim>> boxes;
  cut_recursively(box, count, minimum_width, boxes);
  return boxes;
}

template std::size_t cut_capacity(const Box<2>&, int);
template std::size_t cut_capacity(const Box<3>&, int);
template std::vector<Box<2>> cut_box(const Box<2>&, int, int);
template std::vector<Box<3>> cut_box(const Box<3>&, int, int);

}  // namespace wingbeat
