// Private to check/: which of a mesh's facets is nearest to a point.
#pragma once

#include <array>
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
  /// Leaves, of which each holds some triangles.
  std::size_t leaves() const { return (triangles_.size() + kLeaf - 1) / kLeaf; }
  /// Calls visit(f, g) for pairs of facets, by their numbers in mesh.boundary_facets, whose boxes meet, f in this leaf
  /// and g in this or a later one: over all leaves once for each pair.
  template <class Visit>
  void visit_pairs(std::size_t leaf, const Visit& visit) const {
    visit_pairs(1, leaves_, leaf, boxes_of(leaf), visit);
  }
  /// Of one facet the point nearest to p.
  Point nearest_point(std::uint32_t facet, const Point& p) const { return nearest_on_triangle(p, triangles_[facet]); }
  /// From p to one facet.
  double distance_to(std::uint32_t facet, const Point& p) const { return distance(p, nearest_point(facet, p)); }

 private:
  static constexpr std::size_t kLeaf = 4;  // triangles

  using LeafBoxes = std::array<Box, kLeaf>;

  /// Of its triangles; those beyond the last one are empty, and meet none.
  LeafBoxes boxes_of(std::size_t leaf) const {
    LeafBoxes boxes;
    for (std::size_t n = 0; n < kLeaf && leaf * kLeaf + n < triangles_.size(); ++n) {
      for (const Point& p : triangles_[leaf * kLeaf + n]) boxes[n].extend(p);
    }
    return boxes;
  }
  /// below: leaves below each node of this one's level.
  template <class Visit>
  void visit_pairs(std::size_t node, std::size_t below, std::size_t leaf, const LeafBoxes& own,
                   const Visit& visit) const {
    if ((node + 1) * below - leaves_ <= leaf || !boxes_[node].meets(boxes_[leaves_ + leaf])) return;
    if (below > 1) {
      visit_pairs(2 * node, below / 2, leaf, own, visit);
      visit_pairs(2 * node + 1, below / 2, leaf, own, visit);
      return;
    }
    const std::size_t other = node - leaves_;
    const LeafBoxes others = boxes_of(other);
    for (std::size_t i = 0; i < kLeaf; ++i) {
      for (std::size_t j = other == leaf ? i + 1 : 0; j < kLeaf; ++j) {
        if (own[i].meets(others[j])) visit(facets_[leaf * kLeaf + i], facets_[other * kLeaf + j]);
      }
    }
  }

  std::vector<FacetCorners> triangles_;  // in the order of the leaves
  std::vector<std::uint32_t> facets_;    // their numbers
  std::vector<Box> boxes_;  // of a complete binary tree: the children of box i are 2i and 2i + 1; the root is 1
  std::size_t leaves_ = 0;  // a power of two
};

}  // namespace scantet
