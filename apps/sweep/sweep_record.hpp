#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/io/csv.hpp"

namespace wingbeat {

// What became of a point, a line of sweep.jsonl: {"point", "parameters": {key: value}, "status", "reason",
// "results": [{...}], "start", "seconds"}; with the status "begun" only its first three.
using SweepLine = nlohmann::ordered_json;

// Values as JSON, numbers where they are: 0.80 and 0.8 are one point.
SweepLine parameter_values(const std::vector<std::string>& keys, const std::vector<std::string>& values);

// The lines of a sweep.jsonl after its first: of points that have ended, of two for the same point the later
// alone, and of points that have begun and not ended.
struct SweepLines {
  std::vector<SweepLine> ended, begun;
};

// A last line cut short is left out. Throws InputError where it is no such file, or where its first line
// tells of a case with other values than `head`, naming the keys.
SweepLines read_sweep_lines(const std::string& text, const std::string& path, const SweepLine& head);

// The line for the point of these parameters; null where there is none.
const SweepLine* line_of(const std::vector<SweepLine>& lines, const SweepLine& parameters);

// Adds a line to the file; it is on disk when this returns. Throws InputError where it cannot be written.
void append_line(const std::filesystem::path& path, const SweepLine& line);

// sweep.csv: a row a result, parameters first, then speed, frequency and status, seconds last; points in the
// order of their parameters, a point without results in one row. Flutter roots of one numeric parameter get
// the number of their branch.
CsvTable sweep_table(const std::vector<std::string>& keys, std::vector<SweepLine> lines);

}  // namespace wingbeat
