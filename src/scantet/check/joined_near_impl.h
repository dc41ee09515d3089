// Private to check/: what a mesh has beside ways that its boundary crosses.
#pragma once

#include <span>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/check/audit_impl.h"
#include "scantet/domain/domain.h"

namespace scantet::auditing {

/// Whether all the points lie in one piece of the ways' region in the mesh, or of the outside, that goes on within half
/// a voxel of the ways: it is looked for along lines an eighth of a voxel apart, so what is thinner may not be found.
/// ways: of one region, between nodes of a grid that are neighbours. points: of these nodes, in the region. frame: the
/// grid's.
bool are_joined_near(const TetMesh& mesh, const FaceMatch& match, const Frame& frame, std::span<const NarrowWay> ways,
                     std::span<const Point> points);

}  // namespace scantet::auditing
