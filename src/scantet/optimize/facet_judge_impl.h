// Private: what a boundary facet has of all that is asked of it.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "scantet/domain/domain.h"
#include "scantet/optimize/element_bounds.h"

namespace scantet::optimize {

/// The corners of a boundary facet, world mm.
using Corners = std::array<Point, 3>;

/// The normal of a facet, as long as twice its area.
inline Vec facet_normal(const Corners& c) {
  return cross(c[1] - c[0], c[2] - c[0]);
}

/// For each thing that is asked of a facet, what it has of it, in the way of TetShares.
struct FacetShares {
  double radius_edge;  ///< R1: the bound over the ratio
  double size;         ///< R2: alpha·σ at the ball's centre over its radius; 0 if the ball is missing
  double distance;     ///< R2: the bound over the distance from the circumcentre to the ball's centre

  double least() const { return std::min({radius_edge, size, distance}); }
};

/// Judges boundary facets by R1 and R2. The surface ball of a facet is centred where its axis, the line through its
/// circumcentre along its normal, crosses the boundary of the domain nearest to the circumcentre, and goes through its
/// vertices; it is missing if that is nowhere within alpha·σ(circumcentre). Bounds may be exceeded by 1e-9 of
/// themselves, for rounding. shares() asks the domain once. Const methods may be called from many threads.
class FacetJudge {
 public:
  /// domain and target.size must outlive the judge.
  FacetJudge(const Domain& domain, const RuleTarget& target) : domain_(&domain), target_(target) {}

  /// crossings: room to work in.
  FacetShares shares(const Corners& facet, Crossings& crossings) const;
  /// Its radius_edge alone: does not ask the domain.
  double share_of_shape(const Corners& facet) const;

 private:
  const Domain* domain_;
  RuleTarget target_;
};

}  // namespace scantet::optimize
