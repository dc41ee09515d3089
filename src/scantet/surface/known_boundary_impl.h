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
  explicit KnownBoundary(RestrictedTriangulation& triangulation)
      : triangulation_(triangulation), disks_(triangulation) {}

  const BrokenDisks& disks() const { return disks_; }
  /// Asks of all vertices that are in question.
  void update_disks();

  /// All facets that boundary_facets() gives, in any order, and the surfaces that they form. Valid until the next call
  /// of either.
  const std::vector<FacetCode>& facets();
  const BoundarySurfaces& surfaces();

 private:
  /// What the boundary hangs on, each a number that only grows.
  struct State {
    std::uint64_t vertices = 0;
    std::uint64_t changes_of_sides = 0;
    std::uint64_t disks_asked = 0;  ///< for the facets, which do not hang on it, 0
    bool operator==(const State&) const = default;
  };
  State state(std::uint64_t disks_asked) const {
    return {triangulation_.vertex_count(), triangulation_.changes_of_sides(), disks_asked};
  }

  RestrictedTriangulation& triangulation_;
  BrokenDisks disks_;
  std::uint64_t disks_asked_ = 1;
  State of_facets_;
  std::vector<FacetCode> facets_;
  State of_surfaces_;
  std::unique_ptr<BoundarySurfaces> surfaces_;
};

}  // namespace scantet::engine
