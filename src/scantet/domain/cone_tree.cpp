// A tree of boxes, split at the median of their longest side. A box whose least height plus its distance is no lower
// than the best so far is passed over; both are computed with the same roundings, so the answer is that of asking all.
#include "scantet/domain/cone_tree.h"

#include <algorithm>
#include <cmath>

#include "scantet/base/box_distance.h"

namespace scantet {
namespace {

constexpr std::uint32_t kLeaf = 8;

}  // namespace

ConeTree::ConeTree(std::vector<Cone> cones, double flat_mm) : flat_mm_(flat_mm), cones_(std::move(cones)) {
  if (!cones_.empty()) build(0, static_cast<std::uint32_t>(cones_.size()));
}

std::uint32_t ConeTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  Node node{{}, cones_[begin].height_mm, begin, end, 0};
  for (std::uint32_t i = begin; i < end; ++i) {
    node.box.extend(cones_[i].apex);
    node.least_mm = std::min(node.least_mm, cones_[i].height_mm);
  }
  nodes_.push_back(node);
  if (end - begin <= kLeaf) return id;
  const Vec extent = node.box.extent();
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto earlier = [axis](const Cone& a, const Cone& b) { return a.apex[axis] < b.apex[axis]; };
  std::nth_element(cones_.begin() + begin, cones_.begin() + middle, cones_.begin() + end, earlier);
  build(begin, middle);
  nodes_[id].right = build(middle, end);
  return id;
}

double ConeTree::bound_of(const Node& node, const Point& p) const {
  return node.least_mm + std::max(std::sqrt(squared_distance(node.box, p)) - flat_mm_, 0.0);
}

/// share: a box is passed over if its bound is not under that share of the lowest value.
void ConeTree::search(std::uint32_t id, const Point& p, double share, Lowest& lowest) const {
  const Node& node = nodes_[id];
  if (node.right == 0) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const double value = cones_[i].height_mm + std::max(distance(p, cones_[i].apex) - flat_mm_, 0.0);
      if (value < lowest.value_mm) lowest = {value, &cones_[i]};
    }
    return;
  }
  std::uint32_t near = id + 1;
  std::uint32_t far = node.right;
  double near_bound = bound_of(nodes_[near], p);
  double far_bound = bound_of(nodes_[far], p);
  if (far_bound < near_bound) {
    std::swap(near, far);
    std::swap(near_bound, far_bound);
  }
  if (near_bound < share * lowest.value_mm) search(near, p, share, lowest);
  if (far_bound < share * lowest.value_mm) search(far, p, share, lowest);
}

ConeTree::Lowest ConeTree::lowest_at(const Point& p, double bound_mm, double slack) const {
  Lowest lowest{bound_mm, nullptr};
  if (!nodes_.empty() && bound_of(nodes_[0], p) < bound_mm) search(0, p, 1 / (1 + slack), lowest);
  return lowest;
}

}  // namespace scantet
