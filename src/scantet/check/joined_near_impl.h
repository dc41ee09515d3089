// Private to check/: what a mesh has beside ways that its boundary crosses.
#pragma once

#include <span>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/check/audit_impl.h"
#include "scantet/domain/domain.h"

namespace scantet::auditing {

/// Lines beside ways of a grid, an eighth of a voxel apart and up to half a voxel from them.
class LinesBeside {
 public:
  /// frame: the grid's. What the arguments refer to must outlive this.
  LinesBeside(const TetMesh& mesh, const FaceMatch& match, const Frame& frame);

  /// Whether all the points lie in one piece of the ways' region in the mesh, or of the outside, along these lines;
  /// what is thinner may not be found. ways: of one region, between nodes of the grid that are neighbours. points: of
  /// these nodes, in the region.
  bool join(std::span<const NarrowWay> ways, std::span<const Point> points) const;

 private:
  const TetMesh& mesh_;
  const FaceMatch& match_;
  const Frame& frame_;
  std::vector<Box> boxes_;  // around the faces of the boundary, voxels
};

}  // namespace scantet::auditing
