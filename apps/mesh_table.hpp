#pragma once

#include "core/io/csv.hpp"
#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// Nodes near the walls, for pictures: zone, i, j, x, y of all nodes within `margin` (in the mesh's
// unit) of the box around the walls. Zones and indices count from 1.
CsvTable near_wall_nodes(const MultiblockMesh<2>& mesh, double margin = 0.5);

}  // namespace wingbeat
