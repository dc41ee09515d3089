// What the field consists of beside what the mesh consists of, where the level is regular and where it is not.
#pragma once

#include <vector>

#include "scantet/base/progress.h"
#include "scantet/verify/boundary_rays.h"
#include "scantet/verify/left_out.h"
#include "scantet/verify/matching.h"

namespace scantet::verify {

/// The parts of the field held against those of the mesh.
struct Comparison {
  LeftOut left_out;  ///< what the mesh lacks, as was allowed
  Matching matching;
  std::vector<VerifyFinding> findings;
};

/// Counts the parts of both and matches them. Where nodes or saddles are at the level itself, the level set need not be
/// a surface, and if what is counted then (parts that only touch there are apart) is not the mesh's, or not known, ties
/// are broken: nodes at the level go to the side on which the mesh has them, and the level moves a little
/// (VoxelNodes::break_ties()), so that it passes through no node. From then on `nodes` is that field, which the finding
/// level.tie tells. If neither way gives the mesh's topology, what differs is said of the first, and called wrong only
/// if the numbers of components or cavities differ whichever way ties are broken. shell: closed and manifold. If
/// progress.cancelled() became true, the outcome means nothing.
Comparison compare_parts(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays, VoxelNodes& nodes,
                         const MayBeLeftOut& may_be_left_out, const Progress& progress);

}  // namespace scantet::verify
