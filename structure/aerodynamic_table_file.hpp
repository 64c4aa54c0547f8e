#pragma once

#include <string>
#include <vector>

#include "core/io/csv.hpp"
#include "structure/aerodynamic_table.hpp"

namespace wingbeat {

// Names of the columns of Q(k), m x m, row by row: k, Q11_re, Q11_im, Q12_re, ..., the mode numbers
// joined by _ from ten modes on; for a typical section k, Qhh_re, ..., Qaa_im.
std::vector<std::string> aerodynamic_columns(int modes, bool is_typical_section);

// The samples of a table, a row each.
CsvTable aerodynamic_csv(const AerodynamicTable& table, bool is_typical_section);

// Reads what aerodynamic_csv writes, of m modes; with two modes the columns may have either names. Blank
// lines and lines that start with # are passed over. Throws InputError naming `path` and the line.
AerodynamicTable read_aerodynamic_table(const std::string& text, const std::string& path, int modes);

}  // namespace wingbeat
