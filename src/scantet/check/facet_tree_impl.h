// Private to check/: which of a mesh's facets is nearest to a point.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/check/facet_corners_impl.h"

namespace scantet {

/// The point of a triangle that is nearest to p. Degenerate triangles are as good as others.
Point nearest_on_triangle(const Point& p, const FacetCorners& triangle);

/// Triangles in a tree of boxes. Const methods may be called from many threads.
class FacetTree {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  struct Nearest {
    double distance_mm = std::numeric_limits<double>::infinity();
    std::uint32_t facet = kNone;  ///< its place in the tree: for distance_to() and as a hint
  };

  FacetTree() = default;
  /// facets: those of mesh.boundary_facets that count.
  FacetTree(const TetMesh& mesh, const std::vector<std::uint32_t>& facets);

  bool empty() const { return triangles_.empty(); }
  /// The nearest facet. hint: one that may be near, or kNone; it saves time, and may be the answer where another one is
  /// as near.
  Nearest nearest(const Point& p, std::uint32_t hint = kNone) const;
  /// Calls visit(facet) for the facets, by their numbers in mesh.boundary_facets, whose boxes meet this one.
  template <class Visit>
  void visit_meeting(const Box& box, const Visit& visit) const {
    if (!triangles_.empty()) visit_meeting(1, box, visit);
  }
  /// Of one facet the point nearest to p.
  Point nearest_point(std::uint32_t facet, const Point& p) const { return nearest_on_triangle(p, triangles_[facet]); }
  /// From p to one facet.
  double distance_to(std::uint32_t facet, const Point& p) const { return distance(p, nearest_point(facet, p)); }

 private:
  static constexpr std::size_t kLeaf = 4;  // triangles

  static bool meet(const Box& a, const Box& b) {
    for (int axis = 0; axis < 3; ++axis) {
      if (a.max[axis] < b.min[axis] || b.max[axis] < a.min[axis]) return false;
    }
    return true;
  }
  template <class Visit>
  void visit_meeting(std::size_t node, const Box& box, const Visit& visit) const {
    if (!meet(boxes_[node], box)) return;
    if (node < leaves_) {
      visit_meeting(2 * node, box, visit);
      visit_meeting(2 * node + 1, box, visit);
      return;
    }
    const std::size_t first = (node - leaves_) * kLeaf;
    for (std::size_t i = first; i < std::min(first + kLeaf, triangles_.size()); ++i) {
      Box own;
      for (const Point& p : triangles_[i]) own.extend(p);
      if (meet(own, box)) visit(facets_[i]);
    }
  }

  std::vector<FacetCorners> triangles_;  // in the order of the leaves
  std::vector<std::uint32_t> facets_;    // their numbers
  std::vector<Box> boxes_;  // of a complete binary tree: the children of box i are 2i and 2i + 1; the root is 1
  std::size_t leaves_ = 0;  // a power of two
};

}  // namespace scantet
