// A curve where regions of a label field meet: a polyline for its course, the fields for its points.
#pragma once

#include <vector>

#include "scantet/domain/course_curve.h"
#include "scantet/labels/label_field.h"

namespace scantet {

/// Its points are where the fields of its regions are equal, found by Newton's method from those of the polyline,
/// beside which they lie; where that leads nowhere, the nearest change of regions takes their place. Four regions do
/// not meet in a curve, but in two that are closer to each other than a polyline knows: points are on one of them.
class JunctionCurve final : public CourseCurve {
 public:
  /// field: must outlive the curve. course: with three regions or more, close beside where their fields are equal.
  JunctionCurve(const LabelField& field, PolylineCurve course);

  Point at(double along_mm) const override;
  Nearest nearest(const Point& p) const override;

 private:
  bool is_one_curve() const { return regions_.size() == 3; }

  const LabelField& field_;
  std::vector<Region> regions_;  // each once, ascending
};

}  // namespace scantet
