#pragma once

#include <string>

#include "apps/context.hpp"
#include "structure/aerodynamic_table.hpp"
#include "structure/structure_model.hpp"

namespace wingbeat {

// Q(k) at the case's pk.frequencies, with a line of progress each under this title. Collective.
AerodynamicTable sample_aerodynamics(Context& context, const std::string& title, const AerodynamicMatrix& q);

// pk.table_file, of as many modes as the structure has. Collective.
AerodynamicTable read_aerodynamics(const Context& context, int modes);

// Writes the samples to a file of the output folder. Collective.
void write_aerodynamics(const Context& context, const AerodynamicTable& table, const std::string& file);

// Prints size and phase of the entries of a 2 x 2 matrix, a line a sample; nothing of larger ones.
void print_sizes_and_phases(Context& context, const AerodynamicTable& table);

// The table with Q sampled also where p-k crosses zero: repeated until the crossings lie on samples, so
// that they do not depend on the interpolation.
AerodynamicTable refined_at_crossings(const StructureModel& model, AerodynamicTable table,
                                      const AerodynamicMatrix& q, const std::vector<double>& velocities);

}  // namespace wingbeat
