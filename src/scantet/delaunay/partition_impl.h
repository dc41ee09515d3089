// Private: space cut into parts of about equal work.
#pragma once

#include <vector>

#include "scantet/base/geometry.h"
#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// 2^depth parts of space, cut by planes across the axes where there is about as much work on either side and little
/// near the plane. They depend only on where the work is.
class Partition {
 public:
  static constexpr int kMostCuts = 6;

  /// work: the places of the work, not empty; they are reordered. near_mm: work that near to a cut may have to wait.
  Partition(std::vector<Point>& work, int depth, double near_mm);

  int count() const { return 1 << depth_; }
  PartId of(const Point& p) const {
    std::size_t node = 1;
    for (int level = 0; level < depth_; ++level) node = 2 * node + (p[cuts_[node].axis] < cuts_[node].at ? 0 : 1);
    return static_cast<PartId>(node - (std::size_t{1} << depth_));
  }
  /// The part of each vertex.
  VertexParts parts_of(const Triangulation& t) const;

 private:
  struct Cut {
    int axis = 0;
    double at = 0;
  };
  void cut(std::vector<Point>& work, std::size_t begin, std::size_t end, std::size_t node);

  int depth_;
  double near_mm_;
  std::vector<Cut> cuts_;  // a binary heap: the children of node n are 2n and 2n + 1
};

/// The depth at which each part has at least `least` of so many.
int partition_depth(std::size_t count, std::size_t least);

}  // namespace scantet::engine
