// What the mesher has made, and how it came about.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet {

enum class Stop { converged, cancelled, limit };

/// Points inserted by each rule.
struct RuleCounts {
  std::uint64_t r1 = 0;
  std::uint64_t r2 = 0;
  std::uint64_t r3_1 = 0;
  std::uint64_t r3_2 = 0;
};

/// Elements that violate a rule.
struct UnmetRules {
  std::uint64_t r1 = 0;  ///< restricted facets
  std::uint64_t r2 = 0;  ///< restricted facets
  std::uint64_t r3 = 0;  ///< tets
  std::uint64_t total() const { return r1 + r2 + r3; }
};

/// Where refinement was busy when it hit the limit.
struct LimitReport {
  std::string rule;  ///< the rule that inserted most of the last thousand points: "R1", "R2", "R3.1" or "R3.2"
  Point place;       ///< the last point it inserted, world mm
  double insertion_radius_mm = 0;  ///< distance of that point to its nearest vertex
};

/// A part of the work: what it took and how many points it added.
struct StageAccount {
  /// "boundary sample", "lattice", "triangulate", "classify", "collect" (of what breaks a rule), the rules "R1" to
  /// "R3.2" (the time of the rules is shared out by the threads' time on each), "topology", "untangle", "extract".
  std::string stage;
  double seconds = 0;
  std::uint64_t points = 0;
};

struct MeshResult {
  TetMesh mesh;
  Stop stop = Stop::converged;
  RuleCounts inserted;
  std::uint64_t initial_points = 0;              ///< of the boundary that refinement started from (P_i)
  std::uint64_t lattice_points = 0;              ///< inside, that it started from
  std::uint64_t repair_points = 0;               ///< added where the sample missed topology of the boundary
  std::uint64_t absorbed_tets = 0;               ///< tets that changed sides as fragments: see docs/algorithm.md
  std::vector<Point> tangled;                    ///< where the boundary is not like the domain's: see mesh_domain
  std::vector<Point> sample;                     ///< all points of the triangulation (the paper's P_f)
  std::vector<std::uint8_t> sample_on_boundary;  ///< one per point of `sample`
  UnmetRules unmet;                              ///< left over when stopped early; zero when converged
  std::optional<LimitReport> limit;              ///< set with Stop::limit
  std::vector<StageAccount> stages;              ///< in order; together about sample_s + refine_s
  double sample_s = 0;                           ///< seconds spent on P_i
  double refine_s = 0;                           ///< seconds spent on the rules
};

}  // namespace scantet
