#pragma once

#include <filesystem>

#include "core/mesh/any_mesh.hpp"
#include "core/mesh/cgns_file.hpp"

namespace wingbeat {

// Reads the structured zones of a CGNS file, ADF or HDF5: coordinates in single or double precision,
// GridConnectivity1to1 of any transform, boundary conditions (see read_cgns_boundaries).
// CellDim 2 (in a plane of constant coordinate where PhysDim is 3) gives a 2-D mesh, CellDim 3 one
// cell thick between two symmetry planes too (see collapse_to_2d), any other CellDim 3 a 3-D mesh.
// Zones come in the order written by write_cgns, or else in the file's; left-handed ones are
// reversed. Throws InputError naming file, zone and patch, also for the faults of validate().
AnyMesh read_cgns(const std::filesystem::path& path);

// Writes zones, coordinates (double), interfaces, boundary conditions and families as CGNS (HDF5).
// read_cgns gives the same mesh back, bit for bit. The file appears only when it is complete.
// Throws InputError when it cannot be written or a name is empty, too long (32) or used twice.
template <int Dim>
void write_cgns(const MultiblockMesh<Dim>& mesh, const std::filesystem::path& path);

// The base and zones of `mesh` in a file just created, for files that hold more than a mesh.
// Returns the number of the base; zones are numbered in the mesh's order, from 1.
template <int Dim>
int write_cgns_base(const CgnsFile& file, const MultiblockMesh<Dim>& mesh);

}  // namespace wingbeat
