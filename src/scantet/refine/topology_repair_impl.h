// Private: where the restricted triangulation has not the topology of the domain, and the points that mend it.
#pragma once

#include <vector>

#include "scantet/refine/restricted_triangulation_impl.h"

namespace scantet::refine {

/// Looks for signs that the boundary sample is too sparse, each of which a sample that satisfies I1 cannot show (paper,
/// Theorems 1 and 2, Lemma 3), and returns the boundary points that answer them:
/// - the boundary facets around a vertex do not form one disk: the centre of the largest surface ball around it;
/// - a component or cavity that the domain lists has no restricted facet: points on it;
/// - a component of the domain is in several pieces: on the smaller pieces, the centres of surface balls that are large
///   beside the local thickness, which is where a neck was missed.
class TopologyRepair {
 public:
  /// smallest_ball_mm: balls smaller than that are left as they are, > 0.
  TopologyRepair(const Domain& domain, RestrictedTriangulation& triangulation, double smallest_ball_mm)
      : domain_(domain),
        triangulation_(triangulation),
        smallest_ball_mm_(smallest_ball_mm),
        components_(domain.components()) {}

  /// The points that are missing now; empty when no sign is left that a point could answer.
  std::vector<SamplePoint> missing_points();

  /// Whether, when asked last, there was a disk around every vertex of the boundary and one surface for each of its
  /// components.
  bool is_whole() const { return is_whole_; }

 private:
  void add_balls_at_pinches(const std::vector<FacetCode>& facets);
  void check_components(const std::vector<FacetCode>& facets);
  void check_pieces(const std::vector<FacetCode>& facets);
  void thin_balls_of(FacetCode facet);
  bool larger_than_thickness(const SurfaceBall& ball, FacetCode inside);

  const Domain& domain_;
  RestrictedTriangulation& triangulation_;
  double smallest_ball_mm_;
  std::vector<Component> components_;
  bool is_whole_ = false;
  std::vector<std::uint32_t> balls_;  // whose centres are missing
  std::vector<SamplePoint> points_;   // missing beside them
  Crossings crossings_;
};

}  // namespace scantet::refine
