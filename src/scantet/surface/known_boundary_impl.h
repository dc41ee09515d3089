// Private: the boundary of the triangulation as it was seen last.
#pragma once

#include <memory>
#include <vector>

#include "scantet/surface/boundary_link_impl.h"
#include "scantet/surface/boundary_surfaces_impl.h"

namespace scantet::engine {

/// The boundary, looked at again only if points have been inserted or tets have changed sides since; and its vertices
/// without a disk.
class KnownBoundary {
 public:
  /// There is to be one at a time for a triangulation: it takes its questions and its changes.
  explicit KnownBoundary(RestrictedTriangulation& triangulation)
      : triangulation_(triangulation), disks_(triangulation) {}

  const BrokenDisks& disks() const { return disks_; }
  /// Asks of all vertices that are in question.
  void update_disks();

  /// All facets that boundary_facets() gives, in any order, and the surfaces that they form. Valid until the next call
  /// of either. Where little has changed since the last one, only that is looked at.
  const BoundaryFacets& facets();
  const BoundarySurfaces& surfaces();

 private:
  /// What the facets hang on: numbers that only grow.
  struct State {
    std::uint64_t vertices = 0;
    std::uint64_t changes_of_sides = 0;
    bool operator==(const State&) const = default;
  };

  RestrictedTriangulation& triangulation_;
  BrokenDisks disks_;
  State seen_;
  BoundaryFacets facets_;
  std::unique_ptr<BoundarySurfaces> surfaces_;  // null if not known; they hang on the disks, too
};

}  // namespace scantet::engine
