// Nodes of a grid of heights that lie on the wrong side of a mesh in such a way that its topology is another.
#pragma once

#include <vector>

#include "scantet/domain/domain.h"
#include "scantet/field/height_grid.h"

namespace scantet {

/// What Domain::misplaced tells of a trilinear level set.
///
/// A mesh is coarser than the voxels and passes many nodes on the wrong side, which means nothing as long as bumps and
/// dents are flattened. So nodes on the wrong side are put into groups that touch at faces, edges or corners of their
/// voxels, and a group counts if the inside nodes' Euler number changes where it changes sides, both with voxels joined
/// at corners and with voxels joined at faces. (The simple points of digital topology, for groups: Kong and Rosenfeld,
/// *Digital topology: introduction and survey*, 1989.) It is a sign of a handle that was lost or made, no proof: the
/// level set does not always join nodes as voxels are.
///
/// Nodes up to two voxels from one of the other sign are looked at, nodes at the level are not. A node is in the mesh
/// if nodes_within() says so. boundary: of the mesh. is_asked: as Domain::misplaced() has it. Return: groups in the
/// order of their first nodes.
std::vector<Misplaced> misplaced_nodes(const HeightGrid& heights, const Frame& frame, const TriangleSurface& boundary,
                                       const PlaceFilter& is_asked);

}  // namespace scantet
