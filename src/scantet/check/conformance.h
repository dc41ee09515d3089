// Which elements of a finished mesh break what is asked of them.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/run_account.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"
#include "scantet/optimize/element_bounds.h"

namespace SCANTET_API scantet {

/// The elements that break one bound.
struct BrokenBound {
  std::uint64_t count = 0;
  /// What is bounded, of the element that breaks the bound most. Of one that is degenerate ratios and distances are
  /// infinite, the scaled Jacobian and the least angle 0, the greatest angle 180.
  double worst = 0;
  Point place;  ///< that element's centroid, or the edge's middle, world mm

  friend bool operator==(const BrokenBound&, const BrokenBound&) = default;
};

/// A place with edges that are too short.
struct ShortEdgePlace {
  Point place;              ///< the middle of the edge that is shortest beside what is asked for, world mm
  double length_mm = 0;     ///< its length
  std::uint64_t edges = 0;  ///< how many are too short there

  friend bool operator==(const ShortEdgePlace&, const ShortEdgePlace&) = default;
};

/// Elements that break bounds. One that breaks two is counted under both. Ratios of small elements are those over
/// RuleBounds::small_slack.
struct Conformance {
  BrokenBound min_dihedral;       ///< tets; degrees
  BrokenBound max_dihedral;       ///< tets; degrees
  BrokenBound scaled_jacobian;    ///< tets
  BrokenBound facet_radius_edge;  ///< R1: boundary facets; circumradius / shortest edge
  BrokenBound facet_size;         ///< R2: boundary facets; ball radius / (alpha·σ); infinite if the ball is missing
  BrokenBound facet_distance;     ///< R2: boundary facets; circumcentre to the ball's centre, mm
  BrokenBound tet_size;           ///< R3: tets; circumradius / σ(circumcentre)
  BrokenBound tet_radius_edge;    ///< R3: tets; circumradius / shortest edge
  /// Edges: mm, or where a share of the size is asked for, the share that they have. Not in `places`.
  BrokenBound min_edge;
  /// Where these are, the shortest beside what is asked for first. Edges in one cube of a grid share a place: its side
  /// is the least size, or twenty times the length asked for.
  std::vector<ShortEdgePlace> short_edges;
  UnmetRules unmet;  ///< elements that break a rule
  /// Where smaller elements would help, for all tets, then facets, that break a bound, each once, world mm: the
  /// centroid, or of a needle the vertex far from its shortest edge.
  std::vector<Point> places;
  std::vector<double> edges_mm;  ///< the longest edge of each of these elements
  std::uint64_t facets = 0;      ///< boundary facets in all
  std::uint64_t tets = 0;        ///< tets in all

  /// Whether every bound is kept.
  bool holds() const { return places.empty() && short_edges.empty(); }
  friend bool operator==(const Conformance&, const Conformance&) = default;
};

/// Holds the mesh as it is against the bounds; which points it was once the Delaunay triangulation of does not matter.
/// The rules are not asked of elements with a vertex on a curve or at a corner.
///
/// The surface ball of a facet is centred where its axis, the line through its circumcentre along its normal, crosses
/// the boundary of the domain nearest to the circumcentre, and goes through its vertices; it is missing if that is
/// nowhere within alpha·σ(circumcentre). Sizes and ratios may be exceeded by 1e-9 of themselves, for rounding. A tet
/// without positive volume breaks every bound on tets, and with bounds.rules a degenerate facet every one on facets,
/// asked for or not.
///
/// domain: what the mesh was made from. It and the sizes in `bounds` are asked from several threads at once. Pre: as
/// TetMesh promises. Guarantees: does not depend on the number of threads. Takes one query of the domain a boundary
/// facet, none without bounds.rules.
Conformance check_conformance(const TetMesh& mesh, const Domain& domain, const ElementBounds& bounds);

}  // namespace scantet
