// The least of many functions "height + distance to a point": how sizes that are known at places grow in between.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"

namespace SCANTET_API scantet {

/// The function height_mm + |p - apex|: 1-Lipschitz.
struct Cone {
  Point apex;        ///< world mm
  double height_mm;  ///< at the apex
};

/// A fixed set of cones, to be asked which is lowest. They may be flat around their apexes. Const methods may be called
/// from many threads.
class ConeTree {
 public:
  /// No cones.
  ConeTree() = default;
  /// cones: any number of them, in any order. flat_mm: each cone has its height up to that distance from the apex, and
  /// grows from there. ≥ 0.
  explicit ConeTree(std::vector<Cone> cones, double flat_mm = 0);

  /// What was found at a point.
  struct Lowest {
    double value_mm;   ///< at the point asked for
    const Cone* cone;  ///< the tree's own, and as long there as the tree; null if none is lower than the bound
  };

  /// The lowest cone at p, world mm, if it is lower than bound_mm; else the bound. Without slack it is exact to the
  /// last bit, and as a function of p the value with an infinite bound is 1-Lipschitz (paper, section 5, Eq. (1)).
  /// slack: the answer may be too high by that share of it; saves time where many cones are nearly alike. ≥ 0.
  Lowest lowest_at(const Point& p, double bound_mm, double slack = 0) const;

 private:
  struct Node {
    Box box;          // of the apexes
    double least_mm;  // height
    std::uint32_t begin;
    std::uint32_t end;
    std::uint32_t right;  // child; the left one is the next node. 0: a leaf
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);
  void search(std::uint32_t node, const Point& p, double share, Lowest& lowest) const;
  double bound_of(const Node& node, const Point& p) const;

  double flat_mm_ = 0;
  std::vector<Cone> cones_;
  std::vector<Node> nodes_;
};

}  // namespace scantet
