// The peer: CGAL's Mesh_3 on the same scan at the same criteria, through its own grey-image domain.
#pragma once

#include <cstddef>

#include "scantet/image/level_set.h"
#include "scantet/refine/mesher.h"

namespace scantet::bench {

struct PeerRun {
  std::size_t vertices = 0;
  std::size_t tets = 0;
  double refine_s = 0;  ///< make_mesh_3 without optimisers: initial points and refinement
};

/// Runs CGAL's sequential refinement. The scan's axes must be parallel to the world's (CGAL's image knows spacing
/// only).
PeerRun run_cgal_mesh3(const Scan& scan, const LevelSetSettings& settings, double size_mm,
                       const MesherOptions& options);

}  // namespace scantet::bench
