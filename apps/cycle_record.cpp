#include "apps/cycle_record.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "apps/case_keys.hpp"
#include "apps/flow_setup.hpp"
#include "apps/on_root.hpp"
#include "core/io/changed_keys.hpp"
#include "core/io/csv.hpp"
#include "core/io/error.hpp"
#include "core/io/file.hpp"

namespace wingbeat {
namespace {

using nlohmann::ordered_json;

const std::vector<std::string> cycle_columns{"point",       "instance",   "phase", "plunge", "pitch_deg",
                                             "plunge_rate", "pitch_rate", "cl",    "cd",     "cm"};

// Columns of lco.csv that are numbers of the entry under the same name.
const std::vector<std::string> entry_columns{
    "energy",    "average_energy",         "reduced_velocity",    "speed_index",     "frequency_ratio",
    "harmonics", "highest_harmonic_share", "pitch_amplitude_deg", "plunge_amplitude"};
const std::vector<std::string> count_columns{"newton_iterations", "linear_iterations", "factorizations"};

// Rows of cycles.csv without the number of the point, one an instance.
std::vector<std::vector<double>> instance_rows(const CaseSettings& settings, const CycleSolution& solution) {
  const AeroelasticState& state = solution.state;
  const TimeSpectral time = time_of(state);
  const double mean = section_kinematics(settings).mean_pitch;
  std::vector<std::vector<double>> rows;
  for (int n = 0; n < time.instances(); ++n) {
    const auto y = std::span<const double>(state.y).subspan(static_cast<std::size_t>(4 * n), 4);
    const Coefficients c =
        coefficients(settings, solution.loads[static_cast<std::size_t>(n)], mean + y[pitch_mode]);
    rows.push_back({static_cast<double>(n), time.phase(n), y[0], y[1] * 180.0 / std::numbers::pi, y[2], y[3],
                    c.cl, c.cd, c.cm});
  }
  return rows;
}

void add_rows(CsvTable& table, long point, const std::vector<std::vector<double>>& rows) {
  for (const auto& row : rows) {
    std::vector<CsvTable::Cell> cells{point, static_cast<long>(row[0])};
    cells.insert(cells.end(), row.begin() + 1, row.end());
    table.add(std::move(cells));
  }
}

// A number of an entry; an unknown one stays an empty cell.
CsvTable::Cell cell(const ordered_json& entry, const std::string& name) {
  if (!entry.contains(name) || !entry[name].is_number()) return std::string();
  if (entry[name].is_number_integer()) return entry[name].get<long>();
  return entry[name].get<double>();
}

// Sections whose keys decide over a cycle.
const std::vector<std::string> physics{"mesh", "flow", "pitch", "structure"};

std::vector<ordered_json> lines_of(const std::string& text, const std::string& path) {
  std::vector<ordered_json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(ordered_json::parse(line, nullptr, false));
    if (lines.back().is_discarded())
      throw InputError(
          fmt::format("{}:{}: is not a line of JSON; remove the file to begin anew", path, lines.size()));
  }
  return lines;
}

}  // namespace

CycleRecord::CycleRecord(Context& context)
    : context_(context), case_(key_values(context.settings, physics)) {}

bool CycleRecord::is_same(double a, double b) { return std::abs(a / b - 1.0) < 1e-8; }

void CycleRecord::resume() {
  if (!context_.restart) return;
  const auto path = context_.restart->parent_path() / "lco.jsonl";
  std::string text;
  on_root(context_.comm, [&] {
    if (std::filesystem::is_regular_file(path)) text = read_file(path);
  });
  text = context_.comm.broadcast(text);
  if (text.empty()) return;
  std::vector<ordered_json> lines = lines_of(text, path.string());
  if (const auto changed = changed_keys(lines.front(), case_); !changed.empty())
    throw InputError(fmt::format(
        "{}: its cycles are of a case with other values of {}; give these the values they had, or "
        "restart from a solution.cgns in another folder",
        path.string(), fmt::join(changed, ", ")));
  lines_.assign(lines.begin() + 1, lines.end());
  std::erase_if(lines_, [](const ordered_json& line) { return line["entry"]["status"] != "converged"; });
  for (std::size_t i = 0; i < lines_.size(); ++i) lines_[i]["point"] = i + 1;
  context_.log.line("{} cycles taken over from {}", lines_.size(), path.string());
  write();
}

ordered_json* CycleRecord::find(const CycleSolution& solution) {
  const double v = section_kinematics(context_.settings).reduced_velocity(solution.state.r);
  const auto held = std::ranges::find_if(lines_, [&](const ordered_json& line) {
    const ordered_json& entry = line["entry"];
    return solution.status == SolveStatus::converged && entry["status"] == "converged" &&
           entry["harmonics"] == time_of(solution.state).harmonics() &&
           is_same(entry["reduced_velocity"].get<double>(), v) &&
           is_same(entry["frequency_ratio"].get<double>(), solution.state.omega);
  });
  return held == lines_.end() ? nullptr : &*held;
}

void CycleRecord::add(ordered_json entry, const CycleSolution& solution, bool is_asked) {
  if (ordered_json* held = find(solution)) {
    if (!is_asked || (*held)["asked"].get<bool>()) return;
    (*held)["asked"] = true;
  } else {
    ordered_json line{{"point", lines_.size() + 1}, {"asked", is_asked}};
    line["instances"] = instance_rows(context_.settings, solution);
    line["entry"] = std::move(entry);
    lines_.push_back(std::move(line));
  }
  write();
}

ordered_json CycleRecord::asked() const {
  auto list = ordered_json::array();
  for (const ordered_json& line : lines_)
    if (line["asked"].get<bool>()) list.push_back(line["entry"]);
  return list;
}

bool CycleRecord::has(const char* number, double value) const {
  return std::ranges::any_of(lines_, [&](const ordered_json& line) {
    return line["asked"].get<bool>() && line["entry"]["status"] == "converged" &&
           is_same(line["entry"][number].get<double>(), value);
  });
}

void CycleRecord::write() const {
  std::vector<std::string> columns{"point", "asked"};
  columns.insert(columns.end(), entry_columns.begin(), entry_columns.end());
  columns.insert(columns.end(), {"slope", "flow_residual", "structure_residual"});
  columns.insert(columns.end(), count_columns.begin(), count_columns.end());
  columns.push_back("status");
  CsvTable branch(columns), cycles(cycle_columns);
  std::string text = case_.dump() + "\n";
  for (const ordered_json& line : lines_) {
    const ordered_json& entry = line["entry"];
    std::vector<CsvTable::Cell> row{line["point"].get<long>(), line["asked"].get<bool>() ? 1L : 0L};
    for (const auto& name : entry_columns) row.push_back(cell(entry, name));
    row.push_back(cell(entry, "velocity_slope"));
    row.push_back(cell(entry["residuals"], "flow"));
    row.push_back(cell(entry["residuals"], "structure"));
    for (const auto& name : count_columns) row.push_back(cell(entry, name));
    row.push_back(entry["status"].get<std::string>());
    branch.add(std::move(row));
    add_rows(cycles, line["point"].get<long>(), line["instances"].get<std::vector<std::vector<double>>>());
    text += line.dump() + "\n";
  }
  on_root(context_.comm, [&] {
    write_file(context_.output / "lco.jsonl", text);
    branch.write(context_.output / "lco.csv");
    cycles.write(context_.output / "cycles.csv");
  });
}

void write_cycle(const Context& context, const CycleSolution& solution) {
  CsvTable table(cycle_columns);
  add_rows(table, 1, instance_rows(context.settings, solution));
  on_root(context.comm, [&] { table.write(context.output / "cycles.csv"); });
}

}  // namespace wingbeat
