#include "flow/residual_smoothing.hpp"

#include <algorithm>
#include <string>

#include "core/io/error.hpp"
#include "flow/cell_quantities.hpp"

namespace wingbeat {

template <int Dim>
Vec<double, Dim> smoothing_coefficients(const Vec<double, Dim>& lambda, double ratio) {
  double sum = 0.0;
  for (int d = 0; d < Dim; ++d) sum += lambda[d];
  Vec<double, Dim> eps = scaled_radii(lambda);
  for (int d = 0; d < Dim; ++d) {
    const double share = ratio * eps[d] / sum;
    eps[d] = std::max(0.0, 0.25 * (share * share - 1.0));
  }
  return eps;
}

template <int Dim>
ResidualSmoothing<Dim>::ResidualSmoothing(const FlowDomain<Dim>& domain)
    : domain_(domain), ends_(connect_lines(domain)) {
  for (int d = 0; d < Dim; ++d) {
    for (const FlowBlock<Dim>& block : domain.blocks())
      lines_[static_cast<std::size_t>(d)].emplace_back(mesh_lines(block, d));
    weights_[static_cast<std::size_t>(d)].assign(
        static_cast<std::size_t>(ends_[static_cast<std::size_t>(d)].count), 0.0);
  }
}

template <int Dim>
void ResidualSmoothing<Dim>::set_coefficients(std::span<const double> lambda, int instances, double ratio) {
  const std::vector<double> ratios(static_cast<std::size_t>(domain_.owned_count()), ratio);
  set_coefficients(lambda, instances, ratios);
}

template <int Dim>
void ResidualSmoothing<Dim>::set_coefficients(std::span<const double> lambda, int instances,
                                              std::span<const double> ratios) {
  const auto cells = static_cast<std::size_t>(domain_.owned_count());
  ensure(instances > 0 && lambda.size() == static_cast<std::size_t>(instances) * cells * Dim,
         "smoothing needs the spectral radii of every instance, cell and direction, not " +
             std::to_string(lambda.size()) + " values");
  std::array<std::vector<double>, Dim> eps;
  for (auto& values : eps) values.resize(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    Vec<double, Dim> sum;  // shares of the mean are shares of the sum
    for (std::size_t i = 0; i < static_cast<std::size_t>(instances); ++i)
      for (int d = 0; d < Dim; ++d) sum[d] += lambda[(i * cells + c) * Dim + static_cast<std::size_t>(d)];
    const Vec<double, Dim> of_cell = smoothing_coefficients<Dim>(sum, ratios[c]);
    for (int d = 0; d < Dim; ++d) eps[static_cast<std::size_t>(d)][c] = of_cell[d];
  }
  for (int d = 0; d < Dim; ++d) {
    const auto direction = static_cast<std::size_t>(d);
    for (std::size_t b = 0; b < domain_.blocks().size(); ++b) {
      LineSmoother& lines = lines_[direction][b];
      const auto& first = ends_[direction].first[b];
      lines.factorize(
          std::span<const double>(eps[direction])
              .subspan(static_cast<std::size_t>(lines.lines().first_cell), lines.lines().cell_count()),
          {first[0] >= 0, first[1] >= 0});
    }
    set_weights(d);
  }
}

// The jump t across an interface is the difference of the block solutions on either side less what
// the spikes take off it. The jumps at the far ends are neglected; where the spikes cross blocks
// so thin that these would matter, the diagonal is raised to keep the smoothing positive.
template <int Dim>
void ResidualSmoothing<Dim>::set_weights(int direction) {
  const auto d = static_cast<std::size_t>(direction);
  const LineEnds& ends = ends_[d];
  std::vector<double> own(static_cast<std::size_t>(ends.count) * 2), opposite(own.size());
  for (std::size_t b = 0; b < lines_[d].size(); ++b)
    for (const int end : {0, 1}) {
      const int first = ends.first[b][static_cast<std::size_t>(end)];
      if (first < 0) continue;
      for (int line = 0; line < lines_[d][b].lines().count(); ++line) {
        const EndResponse response = lines_[d][b].response(line, end);
        const auto at = static_cast<std::size_t>(first + line) * 2;
        own[at] = response.own, own[at + 1] = response.far;
      }
    }
  ends.exchange.template gather<double>(own, opposite, 1, 2);
  for (std::size_t e = 0; e < weights_[d].size(); ++e)
    weights_[d][e] =
        1.0 / (own[2 * e] + opposite[2 * e] + std::max(1.0, own[2 * e + 1] + opposite[2 * e + 1]));
}

template <int Dim>
void ResidualSmoothing<Dim>::apply(std::span<double> r, int instances) const {
  ensure(instances > 0 && r.size() == static_cast<std::size_t>(instances) * domain_.state_count(),
         "smoothing needs the residuals of every instance and cell, not " + std::to_string(r.size()) +
             " values");
  for (int d = 0; d < Dim; ++d) smooth(d, r, instances);
}

template <int Dim>
void ResidualSmoothing<Dim>::smooth(int direction, std::span<double> r, int instances) const {
  const auto d = static_cast<std::size_t>(direction);
  const LineEnds& ends = ends_[d];
  const std::size_t end_values = static_cast<std::size_t>(ends.count) * n;
  at_ends_.resize(static_cast<std::size_t>(instances) * end_values);
  opposite_.resize(at_ends_.size());

  // visit(lines, block values, numbers of the first line's ends, end values of the instance)
  const auto for_each_block = [&](auto&& visit) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(instances); ++i)
      for (std::size_t b = 0; b < lines_[d].size(); ++b) {
        const LineSmoother& lines = lines_[d][b];
        double* values =
            r.data() + i * domain_.state_count() + static_cast<std::size_t>(lines.lines().first_cell) * n;
        visit(lines, values, ends.first[b], at_ends_.data() + i * end_values);
      }
  };
  for_each_block([](const LineSmoother& lines, double* values, const std::array<int, 2>& first, double* at) {
    lines.solve<n>(values);
    for (const int end : {0, 1})
      if (const int e = first[static_cast<std::size_t>(end)]; e >= 0)
        lines.copy_end<n>(end, values, at + e * n);
  });

  ends.exchange.template gather<double>(at_ends_, opposite_, instances, n);
  for (std::size_t i = 0; i < static_cast<std::size_t>(instances); ++i)
    for (std::size_t e = 0; e < weights_[d].size(); ++e)
      for (std::size_t v = 0; v < n; ++v) {
        const std::size_t at = i * end_values + e * n + v;
        at_ends_[at] = weights_[d][e] * (opposite_[at] - at_ends_[at]);
      }

  for_each_block([](const LineSmoother& lines, double* values, const std::array<int, 2>& first, double* at) {
    for (const int end : {0, 1})
      if (const int e = first[static_cast<std::size_t>(end)]; e >= 0)
        lines.add_spikes<n>(end, at + e * n, values);
  });
}

template Vec<double, 2> smoothing_coefficients<2>(const Vec<double, 2>&, double);
template Vec<double, 3> smoothing_coefficients<3>(const Vec<double, 3>&, double);
template class ResidualSmoothing<2>;
template class ResidualSmoothing<3>;

}  // namespace wingbeat
