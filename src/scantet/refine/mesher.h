// The mesher: samples the inside and the boundary of a domain at the same time by Delaunay refinement.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

/// How the triangulation starts.
enum class Seeding {
  bulk,  ///< a sample of the boundary and a lattice inside, inserted at once (DESIGN: seeding in bulk)
  paper  ///< the paper's P_i alone: a sample of the boundary
};

/// What the elements must satisfy (paper, section 3), and when to give up.
struct MesherOptions {
  double alpha = 1;              ///< surface Delaunay balls have radius ≤ alpha·σ(centre); > 0
  double facet_radius_edge = 1;  ///< ϱ_f: circumradius / shortest edge of boundary facets; ≥ 1 for termination
  double cell_radius_edge = 2;   ///< ϱ_t: circumradius / shortest edge of tets; ≥ 2 for termination in practice
  std::optional<double> facet_distance_mm;  ///< bound on facet circumcentre to ball centre; > 0
  std::uint64_t max_vertices = 20'000'000;  ///< refinement stops there, with Stop::limit; at 140 million anyway
  std::uint64_t seed = 0;                   ///< of the random order in which the initial sample is drawn
  Seeding seeding = Seeding::bulk;
  std::uint64_t threads = 0;  ///< 0: as many as the machine has cores; the mesh does not depend on it
};

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

/// Meshes the domain. Reference engine: P_i, then rules R1, R2, R3.1, R3.2 in that order until none applies.
///
/// size: the paper's σ. Domain and size are asked from several threads at once (options.threads).
/// Throws Error: usage.option (a bound is not positive and finite), input.empty (the domain has no boundary),
/// usage.max_vertices, usage.size (the boundary alone takes more vertices than allowed, or far more).
/// Guarantees on Stop::converged: every restricted facet has its vertices on the boundary, on the same component of it
/// (but where components touch, with surface balls under 0.001 alpha·σ), radius-edge ratio ≤ facet_radius_edge and
/// surface balls ≤ alpha·σ; every tet has circumradius ≤ σ at its circumcentre, if size.bounds_tets(), and radius-edge
/// ratio ≤ cell_radius_edge. The mesh is as TetMesh promises. Same input, same mesh, bit for bit. MeshResult::tangled
/// has every boundary vertex whose facets do not form a disk, a vertex of each piece that is one with another in the
/// domain, and a point of each component that the mesh has not; if it is empty, the boundary is a manifold and has the
/// components that the domain lists. A cancelled run returns an empty mesh; a limited one, or one
/// that is out of budget, returns what there is.
MeshResult mesh_domain(const Domain& domain, const SizingField& size, const MesherOptions& options, Progress& progress);

/// Goes on from a mesh of the same domain where the size has become smaller: starts from its points instead of P_i.
/// What is counted as initial and lattice points are those. Else as mesh_domain.
MeshResult refine_further(const Domain& domain, const SizingField& size, const MesherOptions& options,
                          const MeshResult& before, Progress& progress);

/// Checks the rules on a finished sample from scratch: triangulates the points anew, asks the domain anew, and counts
/// the elements that violate R1, R2 or R3. Owes nothing to the bookkeeping of mesh_domain.
UnmetRules check_rules(const std::vector<Point>& sample, const std::vector<std::uint8_t>& on_boundary,
                       const Domain& domain, const SizingField& size, const MesherOptions& options);

}  // namespace scantet
