// A curve in a plane along which two regions of a domain meet: a polyline for its course, the domain for its points.
#pragma once

#include <vector>

#include "scantet/cuts/cut_plane.h"
#include "scantet/domain/course_curve.h"
#include "scantet/domain/domain.h"

namespace scantet {

/// The point in a plane, within reach_mm of p straight across a direction in it, where the domain passes from one of
/// two regions into the other; of several the one nearest to p. p: in the plane. pair: ascending.
std::optional<Point> meeting_across(const Domain& domain, const CutPlane& plane, const std::array<Region, 2>& pair,
                                    const Point& p, const Vec& direction, double reach_mm);

/// Its points are on the plane and where the two regions meet, found straight across the polyline; where there is none,
/// the nearest corner of the polyline takes its place.
class RimCurve final : public CourseCurve {
 public:
  /// domain, plane: must outlive the curve. pair: the domain's regions on its sides, ascending. course: in the plane,
  /// its corners where they meet, and what is between no farther from there than beside_mm.
  RimCurve(const Domain& domain, const CutPlane& plane, const std::array<Region, 2>& pair, PolylineCurve course,
           double beside_mm);

  Point at(double along_mm) const override;
  Nearest nearest(const Point& p) const override;

 private:
  Vec direction_at(double along_mm) const;

  const Domain& domain_;
  const CutPlane& plane_;
  std::array<Region, 2> pair_;
  std::vector<double> along_mm_;  // of the polyline's corners
  double beside_mm_;
};

}  // namespace scantet
