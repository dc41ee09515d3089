// Private to check/: what a mesh breaks of the ways from node to node of a grid of regions.
#pragma once

#include <array>
#include <vector>

#include "scantet/check/cell_collapse_impl.h"
#include "scantet/check/grid_nodes_impl.h"

namespace scantet::auditing {

/// Where a boundary crosses an edge of a grid.
struct Crossing {
  GridCell edge;
  double at = 0;  ///< along its axis, in steps of the grid
  friend auto operator<=>(const Crossing&, const Crossing&) = default;
};

/// Adds where a triangle crosses edges of the grid of whole numbers within a box.
void add_crossings(const std::array<Vec, 3>& corners, const Box& box, std::vector<Crossing>& out);

/// Cells of the grid all of whose nodes are in one region, and which the mesh has not in that: nodes that are not kept,
/// edges that the mesh's boundary crosses, and what these are part of. Each once. Of kOutside none if planes have cut
/// the grid. nodes: after find().
std::vector<GridCell> broken_cells(const TetMesh& mesh, const FaceMatch& match, const RegionGrid& grid,
                                   const GridNodes& nodes);

}  // namespace scantet::auditing
