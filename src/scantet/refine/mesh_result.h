// What the mesher has made, and how it came about.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/run_account.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_API scantet {

enum class Stop { converged, cancelled, limit };

/// The mesh, how refinement ended, and what each part of it did.
struct MeshResult {
  TetMesh mesh;
  Stop stop = Stop::converged;
  RefinementCounts counts;           ///< counts.unmet: left over when stopped early; zero when converged
  std::vector<Point> merged_curves;  ///< where curves of the domain are so close to each other that the mesh has one
  std::vector<Point> tangled;        ///< where the boundary is not like the domain's: see mesh_domain
  /// Where the boundary seems to have one handle for another: as many as the domain's, perhaps not the same. No proof.
  std::vector<Point> exchanged_handles;
  /// Where it seems to have a handle more or less, if its Euler number is not the domain's. No proof either.
  std::vector<Point> wrong_handles;
  std::uint64_t wrong_handle_count = 0;         ///< by how many the Euler numbers differ; 0 if that is not known
  bool handles_left_out = false;                ///< the size is too coarse for the domain's handles: none was mended
  bool is_beyond_mending = false;               ///< so much was untangled that points were not tried
  std::vector<Point> sample;                    ///< all points of the triangulation (the paper's P_f)
  std::vector<std::uint8_t> sample_dimensions;  ///< one per point of `sample`: of the stratum that it lies on
  std::optional<LimitReport> limit;             ///< set with Stop::limit
  std::vector<StageAccount> stages;             ///< in order; together about sample_s + refine_s
  double sample_s = 0;                          ///< seconds spent on P_i
  double refine_s = 0;                          ///< seconds spent on the rules
};

}  // namespace scantet
