// What a run did: the engine counts it, reports say it.
#pragma once

#include <cstdint>
#include <string>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"

namespace SCANTET_API scantet {

/// Points inserted by each rule.
struct RuleCounts {
  std::uint64_t r1 = 0;
  std::uint64_t r2 = 0;
  std::uint64_t r3_1 = 0;
  std::uint64_t r3_2 = 0;
};

/// Elements that violate a rule.
struct UnmetRules {
  std::uint64_t r1 = 0;  ///< boundary facets
  std::uint64_t r2 = 0;  ///< boundary facets
  std::uint64_t r3 = 0;  ///< tets

  /// Of all rules; an element that violates two counts twice.
  std::uint64_t total() const { return r1 + r2 + r3; }
  friend bool operator==(const UnmetRules&, const UnmetRules&) = default;
};

/// Where the points of a mesh come from, and what refinement left.
struct RefinementCounts {
  std::uint64_t initial_points = 0;  ///< of the boundary that refinement started from (P_i)
  std::uint64_t lattice_points = 0;  ///< inside, that it started from
  std::uint64_t repair_points = 0;   ///< added beside the rules where the sample missed topology of the boundary
  std::uint64_t absorbed_tets = 0;   ///< tets that changed sides as fragments: see docs/algorithm.md
  RuleCounts inserted;
  UnmetRules unmet;
};

/// Where refinement was busy when it hit the limit.
struct LimitReport {
  /// The rule that inserted most of the last thousand points: "R1", "R2", "R3.1" or "R3.2"; "initial sample" if no rule
  /// has inserted any, and then the rest says nothing.
  std::string rule;
  Point place;                     ///< the last point that was inserted, by whichever rule, world mm
  double insertion_radius_mm = 0;  ///< distance of that point to its nearest vertex
};

/// A part of sampling and refining: what it took and how many points it added to the mesh.
struct StageAccount {
  /// "curves" (if the domain has any), "boundary sample", "lattice", "triangulate", "classify", "collect" (of what
  /// breaks a rule), the rules "R1" to "R3.2" (the time of the rules is shared out by the threads' time on each),
  /// "topology", "untangle", "extract".
  std::string stage;
  double seconds = 0;  ///< wall time
  std::uint64_t points = 0;
};

/// A part of a run beside sampling, refining and improving: reading, checking or writing.
struct PhaseAccount {
  std::string stage;       ///< as ProgressState has it: "read", "audit", "write"
  std::string part;        ///< "input", "sizes", "bounds", "measures", "faces", …; the name of a file written
  double seconds = 0;      ///< wall time
  double cpu_seconds = 0;  ///< processor time of all threads, without child processes
};

/// What one stage of the improvement did.
struct OptimizerStage {
  std::string stage;                   ///< "exude", "improve" or "contract"
  double seconds = 0;                  ///< wall time
  std::uint64_t changes = 0;           ///< vertices pumped, moved, added or removed, and faces and edges reconnected
  double min_dihedral_before_deg = 0;  ///< of the whole mesh
  double min_dihedral_after_deg = 0;   ///< below the one before only where another bound was broken by more
};

}  // namespace scantet
