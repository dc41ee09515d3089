// Private: boundary points beside curves whose patches the triangulation does not see.
#pragma once

#include <array>
#include <vector>

#include "scantet/domain/domain.h"
#include "scantet/surface/extra_point_impl.h"
#include "scantet/surface/restricted_triangulation_impl.h"

namespace scantet::engine {

/// Looks for pieces of curves around which the regions are not those of the domain.
///
/// Balls keep points of the patches off their curve, and where a region is a wedge the tets between them may all be cut
/// off, as their circumcentres are outside of it. Then no facet shows the patches, and no rule asks for points there.
class CurveRepair {
 public:
  CurveRepair(const Domain& domain, const RestrictedTriangulation& triangulation)
      : domain_(domain), triangulation_(triangulation) {}

  /// Points of the patches around such pieces, about as far from them as the balls at their ends are large.
  std::vector<ExtraPoint> points_beside();

 private:
  static constexpr std::size_t kSides = 8;
  /// A circle around the middle of a piece.
  struct Circle {
    std::array<Vec, 2> axes;
    std::array<Region, kSides> regions{};  // at places all around
    std::vector<Point> crossings;          // of the boundary with the lines between these places
    double clear_mm = 0;                   // no vertex may be nearer to a crossing
  };

  void look_around();
  Circle circle_around(const CurvePiece& piece, Crossings& crossings) const;
  bool is_missed(const CurvePiece& piece, const Circle& circle, std::vector<CellId>& star) const;

  const Domain& domain_;
  const RestrictedTriangulation& triangulation_;
  std::vector<Circle> circles_;  // around each piece; empty until they are asked for
};

}  // namespace scantet::engine
