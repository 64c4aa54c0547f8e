#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// One quantity of a zone's cells, the first index fastest. SIDS names: Density, MomentumX,
// EnergyStagnationDensity, Pressure, Mach.
struct SolutionField {
  std::string name;
  std::vector<double> values;
};

// One zone at one time.
template <int Dim>
struct ZoneSolution {
  std::vector<SolutionField> fields;
  std::vector<Vec<double, Dim>> nodes;  // where they are now, the first index fastest; empty: as in the mesh
};

// The whole mesh at one time.
template <int Dim>
struct SolutionInstance {
  double time = 0.0;
  std::vector<ZoneSolution<Dim>> zones;  // in the mesh's order
};

// All instances of a solution and whatever else a restart needs, by name (1 to 32 characters).
template <int Dim>
struct Solution {
  std::vector<SolutionInstance<Dim>> instances;     // times increase
  std::map<std::string, std::vector<double>> data;  // none of them empty
  std::map<std::string, std::string> text;          // likewise; names differ from those of `data`
};

// Writes mesh and solution as one CGNS (HDF5) file that viewers show as a time series: each
// instance is a step of BaseIterativeData with its FlowSolution and, if the nodes move, its
// GridCoordinates; `data` and `text` go to UserDefinedData "RestartData", with the format's number and a
// sum over everything by which damage is found. All numbers are double: read_solution gives them back bit for
// bit, and read_cgns the mesh. The file appears only when it is complete and on the disk; the one before it
// stays as previous_solution(path). Throws InputError when it cannot be written.
template <int Dim>
void write_solution(const std::filesystem::path& path, const MultiblockMesh<Dim>& mesh,
                    const Solution<Dim>& solution);

// "solution.previous.cgns" beside "solution.cgns".
std::filesystem::path previous_solution(const std::filesystem::path& path);

// Reads what write_solution wrote for this mesh. Throws InputError when the file cannot be read,
// holds no solution, or one of another mesh (zones, cells), is damaged, or is of a format that this version
// does not know.
template <int Dim>
Solution<Dim> read_solution(const std::filesystem::path& path, const MultiblockMesh<Dim>& mesh);

}  // namespace wingbeat
