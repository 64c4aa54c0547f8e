#include "structure/sketched_matrix.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "structure/section_matrix.hpp"

namespace wingbeat {
namespace {

constexpr int max_derivatives = 6;
// Where between the least and the greatest k, in their logarithm, the flow is factored.
constexpr std::array<double, 2> places{0.2, 0.85};

using Samples = std::vector<Eigen::MatrixXcd>;

// The greatest change of an entry over the greatest entry.
double relative_change(const Samples& from, const Samples& to) {
  double change = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < to.size(); ++i) {
    change = std::max(change, (to[i] - from[i]).cwiseAbs().maxCoeff());
    largest = std::max(largest, to[i].cwiseAbs().maxCoeff());
  }
  return change / largest;
}

}  // namespace

template <int Dim>
std::optional<AerodynamicTable> sketched_matrix(const FlowLevel<Dim>& level, double flow_speed,
                                                std::span<const double> k, double accuracy,
                                                const GmresOptions& gmres) {
  const auto kappa = [&](double at) { return 2.0 * at * flow_speed; };
  std::array<double, 2> kappas{};
  std::ranges::transform(places, kappas.begin(), [&](double place) {
    return kappa(k.front() * std::pow(k.back() / k.front(), place));
  });
  ReducedResponse<Dim> reduced(level, kappas, gmres);
  reduced.extend();
  Samples before;
  for (int derivatives = 1; derivatives <= max_derivatives; ++derivatives) {
    reduced.extend();
    Samples q;
    for (double at : k) q.push_back(aerodynamic_matrix_of(reduced.at(kappa(at))));
    if (!before.empty() && relative_change(before, q) <= accuracy)
      return AerodynamicTable({k.begin(), k.end()}, std::move(q));
    before = std::move(q);
  }
  return std::nullopt;
}

template std::optional<AerodynamicTable> sketched_matrix<2>(const FlowLevel<2>&, double,
                                                            std::span<const double>, double,
                                                            const GmresOptions&);
template std::optional<AerodynamicTable> sketched_matrix<3>(const FlowLevel<3>&, double,
                                                            std::span<const double>, double,
                                                            const GmresOptions&);

}  // namespace wingbeat
