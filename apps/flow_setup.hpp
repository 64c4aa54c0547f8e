#pragma once

#include "apps/context.hpp"
#include "flow/forced_flow.hpp"
#include "flow/steady_sequence.hpp"
#include "structure/section_kinematics.hpp"
#include "structure/typical_section.hpp"

namespace wingbeat {

// What the recipes build of a case's settings.
template <int Dim>
FlowModel<Dim, double> flow_model(const FlowSettings& settings);
TypicalSection typical_section(const StructureSettings& settings);
// Whether the case describes a structure.
bool has_structure(const CaseSettings& settings);
SectionKinematics section_kinematics(const CaseSettings& settings);

// The axis the section turns about, chords from the leading edge: the elastic axis where the case
// has a structure, else pitch.axis.
Vec<double, 2> rotation_axis(const CaseSettings& settings);

// How the case's meshes are divided: at planes that multigrid can coarsen where it is used.
PartitionOptions partition_options(const CaseSettings& settings);

// The case's mesh and the coarser ones that grid sequencing starts from, coarsest first, shared
// among the ranks; prints their sizes and the partition. Collective.
template <int Dim>
FlowLevels<Dim> make_levels(Context& context, const MultiblockMesh<Dim>& mesh);

PseudoTransientOptions steady_options(const SolverSettings& settings);
SubdomainOptions subdomain_options(const SolverSettings& settings);
GmresOptions gmres_options(const SolverSettings& settings);
ForcedFlowOptions forced_flow_options(const SolverSettings& settings);

// Force and moment coefficients in wind axes, cm nose up about the moment reference.
struct Coefficients {
  double cl = 0.0;
  double cd = 0.0;
  double cm = 0.0;
};
Coefficients coefficients(const CaseSettings& settings, const Loads<double>& loads, double pitch);

}  // namespace wingbeat
