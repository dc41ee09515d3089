// The parts of the field held against those of the mesh.
#pragma once

#include <vector>

#include "scantet/verify/boundary_rays.h"
#include "scantet/verify/field_parts.h"

namespace scantet::verify {

/// What of the field and the mesh is the same.
struct Matching {
  VerifiedInvariants field;
  VerifiedInvariants mesh;
  bool has_same_counts = false;  ///< components and cavities; exact
  bool has_same_euler = false;   ///< in whole, and of each component that could be matched
};

/// Counts both, and adds what differs to `found`, with places: components and cavities that one has and the other has
/// not, Euler numbers that differ. shell: closed and manifold.
Matching match_parts(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays, const VoxelNodes& nodes,
                     const FieldParts& parts, std::vector<VerifyFinding>& found);

}  // namespace scantet::verify
