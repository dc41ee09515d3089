// Private: the plane that points of a surface lie near.
#pragma once

#include <optional>

#include "scantet/base/geometry.h"

namespace scantet::engine {

/// Weighted moments of points around a point in the middle.
class PlaneFit {
 public:
  /// offset: from the point in the middle, mm.
  void add(const Vec& offset, double weight);

  /// The unit normal of the best plane, towards either side. None if there is no clear plane: of fewer than four
  /// points, of points along a line, and of points that are as thick as they are wide.
  std::optional<Vec> normal() const;

 private:
  int count_ = 0;
  double weight_ = 0;
  Vec first_;
  Vec squares_;   // xx, yy, zz
  Vec products_;  // yz, zx, xy
};

}  // namespace scantet::engine
