// A curve where regions of a label field meet: a polyline for its course, the fields for its points.
#pragma once

#include <vector>

#include "scantet/domain/curve.h"
#include "scantet/labels/label_field.h"

namespace scantet {

/// Its points are where the fields of its regions are equal, found by Newton's method from those of the polyline,
/// beside which they lie; where that leads nowhere they are the polyline's. Arc lengths are the polyline's, too.
class JunctionCurve final : public Curve {
 public:
  /// field: must outlive the curve. course: with three regions or more, close beside where their fields are equal.
  JunctionCurve(const LabelField& field, PolylineCurve course);

  double length_mm() const override { return course_.length_mm(); }
  Point at(double along_mm) const override;
  Nearest nearest(const Point& p) const override;
  std::vector<Region> regions() const override { return course_.regions(); }
  std::optional<std::array<std::size_t, 2>> corners() const override { return course_.corners(); }
  std::string name() const override { return course_.name(); }

  /// The polyline.
  const PolylineCurve& course() const { return course_; }

 private:
  const LabelField& field_;
  PolylineCurve course_;
  std::vector<Region> regions_;  // each once, ascending
};

}  // namespace scantet
