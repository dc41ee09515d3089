// Private to check/: what tets of one region join, near some segments.
#pragma once

#include <span>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"

namespace scantet::auditing {

/// Whether tets of the ways' region join all the points, which lie in such tets, through faces that come within half a
/// voxel of the ways. ways: of one region, not kOutside; between nodes of a grid that are neighbours. frame: the
/// grid's.
bool are_joined_near(const TetMesh& mesh, const Frame& frame, std::span<const NarrowWay> ways,
                     std::span<const Point> points);

}  // namespace scantet::auditing
