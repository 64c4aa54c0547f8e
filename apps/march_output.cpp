#include "apps/march_output.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <numbers>

#include "apps/flow_setup.hpp"
#include "apps/linear_flutter_output.hpp"
#include "apps/on_root.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

constexpr const char* header =
    "time,reduced_velocity,energy,plunge,pitch_deg,plunge_rate,pitch_rate,cl,cd,cm,flow_iterations,"
    "coupling_iterations\n";

constexpr std::size_t row_size = 12;

[[noreturn]] void refuse_table(const Context& context) {
  throw InputError(fmt::format("{}: cannot write the file: {}", (context.output / "march.csv").string(),
                               std::strerror(errno)));
}

constexpr double degrees = 180.0 / std::numbers::pi;

}  // namespace

MarchTable::MarchTable(const Context& context, std::vector<double> rows)
    : context_(context), rows_(std::move(rows)) {
  ensure(rows_.size() % row_size == 0, "a march goes on from whole rows");
  on_root(context.comm, [&] {
    const auto path = context.output / "march.csv";
    file_.open(path, std::ios::trunc);
    file_ << header << std::flush;
    for (std::size_t begin = 0; begin < rows_.size(); begin += row_size)
      write(std::span<const double>(rows_).subspan(begin, row_size));
    if (!file_) refuse_table(context);
  });
}

void MarchTable::add(const MarchedStep& step) {
  const CaseSettings& settings = context_.settings;
  const double pitch = section_kinematics(settings).mean_pitch + step.y[1];
  const Coefficients c = coefficients(settings, step.loads, pitch);
  on_root(context_.comm, [&] {
    const std::size_t begin = rows_.size();
    rows_.insert(rows_.end(), {step.time, step.reduced_velocity, step.energy, step.y[0], step.y[1], step.y[2],
                               step.y[3], c.cl, c.cd, c.cm, static_cast<double>(step.flow_iterations),
                               static_cast<double>(step.coupling_iterations)});
    write(std::span<const double>(rows_).subspan(begin));
    if (!file_) refuse_table(context_);
  });
}

void MarchTable::write(std::span<const double> row) {
  // One write a row, so that what is on disk ends with a row.
  file_ << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", row[0], row[1], row[2], row[3],
                       row[4] * degrees, row[5], row[6], row[7], row[8], row[9], static_cast<int>(row[10]),
                       static_cast<int>(row[11]))
        << std::flush;
}

nlohmann::ordered_json march_entry(const CaseSettings& settings, const MarchSummary& summary) {
  const MarchAssessment& found = summary.assessment;
  // In a limit cycle its own period, else the fitted mode's.
  const bool is_cycle = found.verdict == MarchVerdict::limit_cycle;
  nlohmann::ordered_json frequency, frequency_error;
  if (is_cycle) {
    frequency = found.cycle->frequency;
    frequency_error = found.cycle->frequency_error;
  } else if (found.growth) {
    frequency = found.growth->frequency;
    frequency_error = found.growth->frequency_error;
  }
  const auto or_null = [](bool is_known, double value) {
    return is_known ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  };
  const double v = summary.reduced_velocity;
  return {
      {"reduced_velocity", v},
      {"speed_index", speed_index(typical_section(settings.structure), v)},
      {"verdict", to_string(found.verdict)},
      {"growth_rate", or_null(found.growth.has_value(), found.growth ? found.growth->rate : 0.0)},
      {"growth_rate_error", or_null(found.growth.has_value(), found.growth ? found.growth->rate_error : 0.0)},
      {"frequency_ratio", frequency},
      {"frequency_error", frequency_error},
      {"reduced_frequency",
       or_null(!frequency.is_null(), frequency.is_null() ? 0.0 : frequency.get<double>() / (2.0 * v))},
      {"energy", or_null(found.last.has_value(), found.last ? found.last->energy : 0.0)},
      {"energy_error", or_null(found.cycle.has_value(), found.cycle ? found.cycle->energy_error : 0.0)},
      {"pitch_amplitude_deg", summary.pitch_amplitude_deg},
      {"plunge_amplitude", summary.plunge_amplitude},
      {"time_steps", summary.time_steps},
      {"steps_per_period", settings.march.steps_per_period}};
}

void print_march(Context& context, const MarchSummary& summary) {
  const MarchAssessment& found = summary.assessment;
  Log& log = context.log;
  log.line("\n{:<34}{:.8f}", "reduced velocity V = U/(c w_a)", summary.reduced_velocity);
  log.line("{:<34}{}", "the motion", to_string(found.verdict));
  if (found.growth) {
    log.line("{:<34}{:+.6e} +- {:.1e}", "growth rate/w_a", found.growth->rate, found.growth->rate_error);
    log.line("{:<34}{:.8f} +- {:.1e}", "frequency ratio omega/w_a", found.growth->frequency,
             found.growth->frequency_error);
  }
  if (found.last) log.line("{:<34}{:.6e}", "energy of the last period", found.last->energy);
  const bool is_settling =
      found.verdict == MarchVerdict::limit_cycle || found.verdict == MarchVerdict::undecided;
  if (found.cycle && is_settling)
    log.line("{:<34}{:.1e}", "distance to the limit cycle's", found.cycle->energy_error);
  log.line("{:<34}{:.6f} deg, plunge {:.3e} semichords", "pitch amplitude", summary.pitch_amplitude_deg,
           summary.plunge_amplitude);
  log.line("{:<34}{}\n", "time steps", summary.time_steps);
}

}  // namespace wingbeat
