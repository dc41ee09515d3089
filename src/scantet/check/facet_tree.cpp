// Triangles in the order of a space-filling curve make a complete binary tree of boxes, four to a leaf: there is
// nothing to balance, and the levels are filled side by side. A search goes to the nearer child first.
#include <algorithm>
#include <array>
#include <bit>

#include "scantet/base/box_distance.h"
#include "scantet/base/morton_impl.h"
#include "scantet/base/parallel.h"
#include "scantet/check/facet_tree_impl.h"

namespace scantet {
namespace {

/// The place of p on a curve that fills a cube from the least corner of the bounds on.
std::uint64_t curve_place(const Point& p, const Box& bounds, double steps_per_mm) {
  const auto step = [&](int axis) {
    return static_cast<std::uint64_t>(std::clamp((p[axis] - bounds.min[axis]) * steps_per_mm, 0.0, kLastMortonStep));
  };
  return interleave({step(0), step(1), step(2)});
}

}  // namespace

// The region of the triangle's plane (corner, edge, inside) is found by signs (Ericson, Real-Time Collision Detection,
// 5.1.5).
Point nearest_on_triangle(const Point& p, const FacetCorners& triangle) {
  const auto& [a, b, c] = triangle;
  const Vec ab = b - a;
  const Vec ac = c - a;
  const Vec ap = p - a;
  const double d1 = dot(ab, ap);
  const double d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec bp = p - b;
  const double d3 = dot(ab, bp);
  const double d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return a + d1 / (d1 - d3) * ab;
  const Vec cp = p - c;
  const double d5 = dot(ab, cp);
  const double d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0 && d4 - d3 + (d5 - d6) > 0) {
    return b + (d4 - d3) / (d4 - d3 + (d5 - d6)) * (c - b);
  }
  const double sum = va + vb + vc;
  if (!(sum > 0)) return a;
  return a + vb / sum * ab + vc / sum * ac;
}

FacetTree::FacetTree(const TetMesh& mesh, const std::vector<std::uint32_t>& facets) {
  if (facets.empty()) return;
  const auto centroid = [&](std::size_t i) { return centroid_of(corners_of(mesh, facets[i])); };
  const Box bounds = parallel_bounds(facets.size(), centroid);
  const Vec extent = bounds.extent();
  const double longest = std::max({extent.x, extent.y, extent.z});
  const double steps_per_mm = longest > 0 ? kLastMortonStep / longest : 0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(facets.size());
  parallel_for(facets.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) order[i] = {curve_place(centroid(i), bounds, steps_per_mm), facets[i]};
  });
  parallel_sort(order, [](const auto& a, const auto& b) { return a < b; });
  triangles_.resize(facets.size());
  facets_.resize(facets.size());
  leaves_ = std::bit_ceil((facets.size() + kLeaf - 1) / kLeaf);
  boxes_.resize(2 * leaves_);
  parallel_for((facets.size() + kLeaf - 1) / kLeaf, 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      Box& box = boxes_[leaves_ + leaf];
      for (std::size_t i = leaf * kLeaf; i < std::min((leaf + 1) * kLeaf, facets.size()); ++i) {
        facets_[i] = order[i].second;
        triangles_[i] = corners_of(mesh, order[i].second);
        for (const Point& p : triangles_[i]) box.extend(p);
      }
    }
  });
  for (std::size_t i = leaves_ - 1; i > 0; --i) {
    boxes_[i].unite(boxes_[2 * i]);
    boxes_[i].unite(boxes_[2 * i + 1]);
  }
}

FacetTree::Nearest FacetTree::nearest(const Point& p, std::uint32_t hint) const {
  struct Waiting {
    std::size_t node;
    double squared;
  };
  double best = std::numeric_limits<double>::infinity();
  std::uint32_t facet = kNone;
  const auto look_at = [&](std::size_t i) {
    const double squared = squared_distance(p, nearest_on_triangle(p, triangles_[i]));
    if (squared < best) best = squared, facet = static_cast<std::uint32_t>(i);
  };
  if (triangles_.empty()) return {};
  if (hint != kNone) look_at(hint);
  std::array<Waiting, 64> stack;  // one for each level, which are fewer
  std::size_t waiting = 0;
  stack[waiting++] = {1, squared_distance(boxes_[1], p)};
  while (waiting > 0) {
    auto [node, squared] = stack[--waiting];
    while (squared < best && node < leaves_) {
      Waiting near{2 * node, squared_distance(boxes_[2 * node], p)};
      Waiting far{2 * node + 1, squared_distance(boxes_[2 * node + 1], p)};
      if (far.squared < near.squared) std::swap(near, far);
      if (far.squared < best) stack[waiting++] = far;
      node = near.node;
      squared = near.squared;
    }
    if (!(squared < best)) continue;
    const std::size_t first = (node - leaves_) * kLeaf;
    for (std::size_t i = first; i < std::min(first + kLeaf, triangles_.size()); ++i) look_at(i);
  }
  return {std::sqrt(best), facet};
}

}  // namespace scantet
