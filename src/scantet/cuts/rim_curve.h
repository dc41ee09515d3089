// A curve in a plane along which two regions of a domain meet: a polyline for its course, the domain for its points.
#pragma once

#include <vector>

#include "scantet/cuts/cut_plane.h"
#include "scantet/domain/course_curve.h"
#include "scantet/domain/domain.h"

namespace scantet {

/// The regions left and right of a way through a plane, seen from beyond it.
struct RimSides {
  Region left;
  Region right;
};

/// The point in a plane, within reach_mm of p straight across a direction in it, where the domain passes from the
/// region on the right into that on the left; of several the one nearest to p. p: in the plane. Where rims are close to
/// each other, those next to each other run past in opposite directions.
std::optional<Point> meeting_across(const Domain& domain, const CutPlane& plane, const RimSides& sides, const Point& p,
                                    const Vec& direction, double reach_mm);

/// Its points are on the plane and where the two regions meet, found straight across the polyline; where there is none,
/// the nearest corner of the polyline takes its place.
class RimCurve final : public CourseCurve {
 public:
  /// domain, plane: must outlive the curve. sides: the domain's regions. course: in the plane, its corners where they
  /// meet, and what is between no farther from there than beside_mm.
  RimCurve(const Domain& domain, const CutPlane& plane, const RimSides& sides, PolylineCurve course, double beside_mm);

  Point at(double along_mm) const override;
  Nearest nearest(const Point& p) const override;

 private:
  Vec direction_at(double along_mm) const;

  const Domain& domain_;
  const CutPlane& plane_;
  RimSides sides_;
  std::vector<double> along_mm_;  // of the polyline's corners
  double beside_mm_;
};

}  // namespace scantet
