// A curve that runs beside a polyline.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scantet/domain/curve.h"

namespace scantet {

/// A curve whose arc lengths, regions, corners and name are those of a polyline, its course; its points lie beside it.
class CourseCurve : public Curve {
 public:
  explicit CourseCurve(PolylineCurve course) : course_(std::move(course)) {}

  double length_mm() const final { return course_.length_mm(); }
  std::vector<Region> regions() const final { return course_.regions(); }
  std::optional<std::array<std::size_t, 2>> corners() const final { return course_.corners(); }
  std::string name() const final { return course_.name(); }

  /// The polyline.
  const PolylineCurve& course() const { return course_; }

 private:
  PolylineCurve course_;
};

}  // namespace scantet
