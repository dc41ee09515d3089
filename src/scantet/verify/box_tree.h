// Boxes in a tree: which of them a box meets, and which thing in them is nearest to a point.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "scantet/base/geometry.h"
#include "scantet/base/parallel.h"

namespace scantet::verify {

/// Whether two boxes have a point in common.
inline bool meet(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.max[axis] < b.min[axis] || b.max[axis] < a.min[axis]) return false;
  }
  return true;
}

/// The square of the distance of a point from a box, to rounding.
inline double squared_gap(const Point& p, const Box& box) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double gap = std::max({0.0, box.min[axis] - p[axis], p[axis] - box.max[axis]});
    sum += gap * gap;
  }
  return sum;
}

/// Immutable.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (order_.empty()) return;
    const auto count = static_cast<std::uint32_t>(order_.size());
    nodes_.resize(nodes_of(count));
    build(0, 0, count);
  }

  const Box& box(std::size_t i) const { return boxes_[i]; }
  /// The box around all; there must be one.
  const Box& around() const { return nodes_[0].box; }

  /// Calls visit(i) for every box i that meets `box`.
  template <class Visit>
  void visit_meeting(const Box& box, const Visit& visit) const {
    descend([&](const Box& node) { return meet(node, box); }, visit);
  }

  /// The least of distance2(i), which must be at least the square of the distance of p from box i, over all i; or one
  /// of them that is at most `enough2`, whichever is found first.
  template <class Distance2>
  double nearest2(const Point& p, double enough2, const Distance2& distance2) const {
    double best = std::numeric_limits<double>::infinity();
    std::uint32_t stack[128];
    int depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth > 0 && best > enough2) {
      const std::uint32_t at = stack[--depth];
      const Node& node = nodes_[at];
      if (squared_gap(p, node.box) >= best) continue;
      if (node.right == 0) {
        for (std::uint32_t n = node.begin; n < node.end; ++n) {
          if (squared_gap(p, boxes_[order_[n]]) < best) best = std::min(best, distance2(order_[n]));
        }
        continue;
      }
      const bool left_first = squared_gap(p, nodes_[at + 1].box) < squared_gap(p, nodes_[node.right].box);
      stack[depth++] = left_first ? node.right : at + 1;
      stack[depth++] = left_first ? at + 1 : node.right;
    }
    return best;
  }

 private:
  struct Node {
    Box box;
    std::uint32_t begin;  // of order_
    std::uint32_t end;
    std::uint32_t right;  // the node after this one's left part; 0: a leaf
  };

  template <class Enters, class Visit>
  void descend(const Enters& enters, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::uint32_t stack[64];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t at = stack[--depth];
      const Node& node = nodes_[at];
      if (!enters(node.box)) continue;
      if (node.right == 0) {
        for (std::uint32_t n = node.begin; n < node.end; ++n) {
          if (enters(boxes_[order_[n]])) visit(order_[n]);
        }
      } else {
        stack[depth++] = node.right;
        stack[depth++] = at + 1;
      }
    }
  }

  static constexpr std::uint32_t kLeaf = 4;  // boxes

  /// How many nodes a tree of so many boxes has.
  static std::uint32_t nodes_of(std::uint32_t boxes) {
    return boxes <= kLeaf ? 1 : 1 + nodes_of(boxes / 2) + nodes_of(boxes - boxes / 2);
  }

  /// at: of the node; those below it follow.
  void build(std::uint32_t at, std::uint32_t begin, std::uint32_t end) {
    Node& node = nodes_[at];
    node = {{}, begin, end, 0};
    Box centers;
    for (std::uint32_t n = begin; n < end; ++n) {
      node.box.unite(boxes_[order_[n]]);
      centers.extend(boxes_[order_[n]].center());
    }
    if (end - begin <= kLeaf) return;
    const Vec extent = centers.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return boxes_[a].min[axis] + boxes_[a].max[axis] < boxes_[b].min[axis] + boxes_[b].max[axis];
                     });
    node.right = at + 1 + nodes_of(middle - begin);
    constexpr std::uint32_t kSideBySide = 4096;
    if (end - begin < kSideBySide) {
      build(at + 1, begin, middle);
      build(node.right, middle, end);
      return;
    }
    parallel_for(2, 1, [&](std::size_t half, std::size_t) {
      half == 0 ? build(at + 1, begin, middle) : build(node.right, middle, end);
    });
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace scantet::verify
