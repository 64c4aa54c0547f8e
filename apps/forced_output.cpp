#include "apps/forced_output.hpp"

#include <array>
#include <numbers>
#include <utility>

#include "apps/on_root.hpp"
#include "core/io/csv.hpp"
#include "structure/section_kinematics.hpp"

namespace wingbeat {
namespace {

using Complex = std::complex<double>;
using Json = nlohmann::ordered_json;

Json json_of(Complex value) { return Json::array({value.real(), value.imag()}); }

// Harmonics [n] of one coefficient.
std::vector<Complex> harmonics_of(const TimeSpectral& time, const std::vector<Coefficients>& loads,
                                  double Coefficients::*member) {
  std::vector<double> values;
  for (const Coefficients& c : loads) values.push_back(c.*member);
  return time.harmonics_of(values);
}

void write_loads(const Context& context, const TimeSpectral& time, const std::vector<Coefficients>& loads) {
  const ForcedMotion motion = forced_motion(context.settings.pitch);
  CsvTable table({"phase", "pitch_deg", "plunge", "cl", "cd", "cm"});
  for (int n = 0; n < time.instances(); ++n) {
    const ForcedPosition at = position_at(motion, time.phase(n));
    const Coefficients& c = loads[static_cast<std::size_t>(n)];
    table.add(std::vector<double>{time.phase(n), at.pitch * 180.0 / std::numbers::pi,
                                  at.plunge / SectionKinematics::semichord, c.cl, c.cd, c.cm});
  }
  on_root(context.comm, [&] { table.write(context.output / "loads.csv"); });
}

constexpr std::array<const char*, 4> entry_names{"Qhh", "Qha", "Qah", "Qaa"};
Complex entry(const Eigen::Matrix2cd& q, std::size_t e) {
  return q(static_cast<Eigen::Index>(e / 2), static_cast<Eigen::Index>(e % 2));
}

}  // namespace

void report_forced_loads(Context& context, const TimeSpectral& time, const std::vector<Coefficients>& loads,
                         const ForcedFlowResult& result) {
  write_loads(context, time, loads);
  const auto cl = harmonics_of(time, loads, &Coefficients::cl);
  const auto cd = harmonics_of(time, loads, &Coefficients::cd);
  const auto cm = harmonics_of(time, loads, &Coefficients::cm);

  auto instances = Json::array(), harmonics = Json::array();
  for (std::size_t n = 0; n < loads.size(); ++n)
    instances.push_back({{"phase", time.phase(static_cast<int>(n))},
                         {"cl", loads[n].cl},
                         {"cd", loads[n].cd},
                         {"cm", loads[n].cm}});
  for (std::size_t n = 0; n < cl.size(); ++n)
    harmonics.push_back({{"n", n}, {"cl", json_of(cl[n])}, {"cd", json_of(cd[n])}, {"cm", json_of(cm[n])}});
  context.result.findings["pitch"] = {{"reduced_frequency", *context.settings.pitch.reduced_frequency},
                                      {"instances", std::move(instances)},
                                      {"harmonics", std::move(harmonics)},
                                      {"residual", result.residual},
                                      {"iterations", result.iterations},
                                      {"linear_iterations", result.linear_iterations},
                                      {"factorizations", result.factorizations},
                                      {"cycles", result.cycles}};

  context.log.line("\nloads f = sum of Re(f_n e^(i n theta)), pitch a sine at n = 1");
  context.log.line("{:>3}  {:^23}  {:^23}  {:^23}", "n", "cl", "cd", "cm");
  const auto text = [](Complex c) { return fmt::format("{:+.7f} {:+.7f}i", c.real(), c.imag()); };
  for (std::size_t n = 0; n < cl.size(); ++n)
    context.log.line("{:3}  {:>23}  {:>23}  {:>23}", n, text(cl[n]), text(cd[n]), text(cm[n]));
  context.log.line("residual {:.1e}; {} cycles, {} Newton, {} Krylov, {} new factorizations\n",
                   result.residual, result.cycles, result.iterations, result.linear_iterations,
                   result.factorizations);
}

void report_derivatives(Context& context, const Eigen::Matrix2cd& forced,
                        const Eigen::Matrix2cd& linearized) {
  const double k = *context.settings.pitch.reduced_frequency;
  std::vector<std::string> columns{"method", "k"};
  for (const char* name : entry_names)
    for (const char* part : {"_re", "_im"}) columns.push_back(std::string(name) + part);
  CsvTable table(columns);
  Json findings{{"amplitude_deg", context.settings.pitch.derivative_amplitude_deg}};
  context.log.line("derivatives (-C_l, 2 C_m) per semichord of plunge h and per radian of pitch a");
  context.log.line("{:>10} {:>21} {:>21} {:>21} {:>21}", "", "Qhh", "Qha", "Qah", "Qaa");
  for (const auto& [method, q] : {std::pair{"forced", &forced}, std::pair{"linearized", &linearized}}) {
    std::vector<CsvTable::Cell> row{std::string(method), k};
    Json entries;
    std::string line = fmt::format("{:>10}", method);
    for (std::size_t e = 0; e < entry_names.size(); ++e) {
      const Complex value = entry(*q, e);
      row.insert(row.end(), {value.real(), value.imag()});
      entries[entry_names[e]] = json_of(value);
      line += fmt::format(" {:>21}", fmt::format("{:+.6f}{:+.6f}i", value.real(), value.imag()));
    }
    context.log.line("{}", line);
    table.add(std::move(row));
    findings[method] = std::move(entries);
  }
  const double difference = (forced - linearized).norm() / linearized.norm();
  context.log.line("relative difference {:.1e}\n", difference);
  findings["difference"] = difference;
  context.result.findings["pitch"]["derivatives"] = std::move(findings);
  on_root(context.comm, [&] { table.write(context.output / "derivatives.csv"); });
}

}  // namespace wingbeat
