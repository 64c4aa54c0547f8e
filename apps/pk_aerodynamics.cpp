#include "apps/pk_aerodynamics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/on_root.hpp"
#include "core/io/file.hpp"
#include "core/io/progress.hpp"
#include "structure/aerodynamic_table_file.hpp"
#include "structure/pk.hpp"

namespace wingbeat {
namespace {

std::string complex_text(std::complex<double> q) { return fmt::format("{:.3f}{:+.3f}i", q.real(), q.imag()); }

std::string polar_text(std::complex<double> q) {
  return fmt::format("{:.4f} {:+7.2f}", std::abs(q), std::arg(q) * 180.0 / std::numbers::pi);
}

// Closer samples would tell the spline nothing but round-off.
bool has_sample_at(const AerodynamicTable& table, double k) {
  return std::ranges::any_of(table.sampled_k(),
                             [k](double sample) { return std::abs(sample - k) <= 1e-6 * k; });
}

}  // namespace

AerodynamicTable sample_aerodynamics(Context& context, const std::string& title, const AerodynamicMatrix& q) {
  const auto part = context.timer.measure(title);
  const auto [k_min, k_max] = context.settings.flutter.reduced_frequency_range;
  const std::vector<double> ks = spread_reduced_frequencies(k_min, k_max, context.settings.pk.frequencies);
  Progress progress(context.log, title, {"k", "Qhh", "Qha", "Qah", "Qaa"});
  std::size_t done = 0;
  return tabulate(
      [&](double k) {
        const Eigen::MatrixXcd sample = q(k);
        progress.row({fmt::format("{:.4f}", k), complex_text(sample(0, 0)), complex_text(sample(0, 1)),
                      complex_text(sample(1, 0)), complex_text(sample(1, 1))},
                     static_cast<double>(++done) / static_cast<double>(ks.size()));
        return sample;
      },
      ks);
}

AerodynamicTable read_aerodynamics(const Context& context, int modes) {
  const std::string& path = *context.settings.pk.table_file;
  std::string text;
  on_root(context.comm, [&] { text = read_file(path); });
  return read_aerodynamic_table(context.comm.broadcast(text), path, modes);
}

void write_aerodynamics(const Context& context, const AerodynamicTable& table, const std::string& file) {
  const CsvTable csv = aerodynamic_csv(table, !context.settings.modal.is_given());
  on_root(context.comm, [&] { csv.write(context.output / file); });
}

void print_sizes_and_phases(Context& context, const AerodynamicTable& table) {
  if (table.size() != 2) return;
  context.log.line("\nsize and phase in degrees of the aerodynamic matrix");
  context.log.line("{:>8} {:>18} {:>18} {:>18} {:>18}", "k", "Qhh", "Qha", "Qah", "Qaa");
  for (std::size_t j = 0; j < table.samples().size(); ++j) {
    const Eigen::MatrixXcd& q = table.samples()[j];
    context.log.line("{:8.4f} {:>18} {:>18} {:>18} {:>18}", table.sampled_k()[j], polar_text(q(0, 0)),
                     polar_text(q(0, 1)), polar_text(q(1, 0)), polar_text(q(1, 1)));
  }
}

AerodynamicTable refined_at_crossings(const StructureModel& model, AerodynamicTable table,
                                      const AerodynamicMatrix& q, const std::vector<double>& velocities) {
  constexpr int max_repeats = 4;
  for (int repeat = 0; repeat < max_repeats; ++repeat) {
    std::vector<double> missing;
    for (const PkCrossing& crossing : pk(model, table, velocities).crossings)
      if (const double k = crossing.point.reduced_frequency(); !has_sample_at(table, k)) missing.push_back(k);
    if (missing.empty()) break;
    table = with_samples(table, q, missing);
  }
  return table;
}

}  // namespace wingbeat
