// What is measured of one run.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scantet/base/stopwatch.h"
#include "scantet/base/tet_mesh.h"

namespace scantet::bench {

struct Stage {
  std::string stage;
  double seconds = 0;
  std::uint64_t points = 0;
};

/// Zero or empty: does not apply to the contestant.
struct Figures {
  double prepare_s = 0;  ///< wall time from the voxels in memory to a domain that can be asked
  double seconds = 0;    ///< the figure compared: scantet's sample + refine, CGAL's make_mesh_3, or the triangulation
  double wall_s = 0;     ///< of the whole call
  double cpu_s = 0;      ///< of all threads in the call
  std::uint64_t peak_bytes = 0;  ///< the call's peak of resident memory over what was resident before it
  std::uint64_t vertices = 0;
  std::uint64_t boundary_vertices = 0;
  std::uint64_t tets = 0;
  std::uint64_t components = 0;  ///< of the mesh, and cavities in it
  std::uint64_t cavities = 0;
  std::uint64_t regions = 0;            ///< of the mesh
  std::uint64_t object_components = 0;  ///< of the object, if scantet's domain knows
  std::uint64_t object_cavities = 0;
  double min_dihedral_deg = 0;
  std::uint64_t tets_under_10_deg = 0;
  double max_radius_edge = 0;
  std::uint64_t unmet = 0;  ///< elements that break a rule, by the contestant's own account
  std::string stop;         ///< "converged" or "limit"
  std::string mesh_sha256;  ///< of the mesh's arrays
  std::vector<Stage> stages;
};

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Stage, stage, seconds, points)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Figures, prepare_s, seconds, wall_s, cpu_s, peak_bytes, vertices, boundary_vertices,
                                   tets, components, cavities, regions, object_components, object_cavities,
                                   min_dihedral_deg, tets_under_10_deg, max_radius_edge, unmet, stop, mesh_sha256,
                                   stages)

/// Time and memory from its construction on.
class Meter {
 public:
  Meter();
  /// Fills wall_s, cpu_s and peak_bytes; `seconds` with the wall time.
  void read(Figures& figures) const;

 private:
  std::uint64_t resident_before_;
  double cpu_before_s_;
  Stopwatch wall_;  // last: starts when the rest is ready
};

/// Fills the counts, the topology, the quality and the checksum.
void describe(const TetMesh& mesh, Figures& figures);

}  // namespace scantet::bench
