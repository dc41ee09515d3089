// What the mesher has made, and how it came about.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/run_account.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_API scantet {

/// How refinement ended: no rule is broken; by Progress::cancelled(), without a mesh; or, with the mesh by then, at
/// MesherOptions::max_vertices or the end of a budget. A budget that ends before the rules begin counts as cancelled.
enum class Stop { converged, cancelled, limit };

/// The mesh, how refinement ended, and what each part of it did. Points are world mm.
struct MeshResult {
  TetMesh mesh;  ///< empty if cancelled
  Stop stop = Stop::converged;
  RefinementCounts counts;           ///< counts.unmet: what is left; when converged only what no point can mend
  std::vector<Point> merged_curves;  ///< where curves of the domain are so close to each other that the mesh has one
  std::vector<Point> tangled;        ///< where the boundary is not like the domain's: see mesh_domain
  /// Where the boundary seems to have one handle for another: as many as the domain's, perhaps not the same. No proof.
  std::vector<Point> exchanged_handles;
  /// Where it seems to have a handle more or less, if its Euler number is not the domain's. No proof either.
  std::vector<Point> wrong_handles;
  /// Where tets have changed sides, as the boundary was pinched there: what that joins or cuts may be joined or cut
  /// otherwise in the domain.
  std::vector<Point> turned;
  /// Where the domain, or a gap in it, is a sheet thinner than a tenth of the largest boundary elements: no
  /// more points were spent on its topology, as they had only made more pinches.
  std::vector<Point> thin_sheets;
  std::uint64_t wrong_handle_count = 0;  ///< handles by which the Euler numbers differ; 0 if that is not known
  bool handles_left_out = false;         ///< too many handles are broken at this size: no more were mended
  bool is_noise = false;                 ///< at this size (domain/noise.h): the topology was not mended
  bool is_beyond_mending = false;        ///< that, or so many tets changed sides that points were not tried for them
  std::vector<Point> sample;             ///< all points of the triangulation (the paper's P_f); none if cancelled
  std::vector<std::uint8_t> sample_dimensions;  ///< one per point of `sample`: Stratum::dimension, 0 to 3
  std::optional<LimitReport> limit;             ///< set with Stop::limit
  std::vector<StageAccount> stages;             ///< in order; together about sample_s + refine_s
  double sample_s = 0;                          ///< seconds of wall time spent on the points to start from
  double refine_s = 0;                          ///< and on all that comes after; 0 if cancelled before the rules
};

}  // namespace scantet
