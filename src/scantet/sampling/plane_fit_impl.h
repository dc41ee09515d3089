// Private: the plane that points of a surface lie near.
#pragma once

#include <optional>

#include "scantet/base/geometry.h"

namespace scantet::engine {

/// Weighted moments of points around one of them.
class PlaneFit {
 public:
  /// offset: from the point in the middle, mm.
  void add(const Vec& offset, double weight);

  /// Unit normal of the best plane, of either sign; nothing if there is no clear one: fewer than four points, points
  /// along a line, or as thick as they are wide.
  std::optional<Vec> normal() const;

 private:
  int count_ = 0;
  double weight_ = 0;
  Vec first_;
  Vec squares_;   // xx, yy, zz
  Vec products_;  // yz, zx, xy
};

}  // namespace scantet::engine
