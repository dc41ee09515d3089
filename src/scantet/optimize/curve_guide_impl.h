// Private: keeps vertices of curves on them while they move.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet::optimize {

/// The curves of a domain. Const methods may be called from many threads at once.
class CurveGuide {
 public:
  explicit CurveGuide(const Domain& domain);

  /// The curve that p lies on; null if it lies on none, on several, or at a corner.
  const Curve* curve_at(const Point& p) const;

  /// Where a way along a curve leads from a point of it; nothing if that is beyond an end. step_mm: against the curve's
  /// direction if negative, and less than its length.
  static std::optional<Point> step_along(const Curve& curve, const Point& from, double step_mm);

 private:
  struct Entry {
    std::shared_ptr<const Curve> curve;
    Box box;  // around it
  };

  std::vector<Entry> curves_;
  double within_mm_;  // what is nearer to a curve is on it
};

}  // namespace scantet::optimize
