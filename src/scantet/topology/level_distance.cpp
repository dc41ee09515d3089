// Beside the level set, at a node with crossings at a, b, c along the axes, the plane through them is at the distance
// 1/√(1/a² + 1/b² + 1/c²). Each node remembers for which such place its distance stands, so that errors do not add up
// along the way.
#include "scantet/topology/level_distance.h"

#include <algorithm>
#include <cmath>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/topology/bucket_queue.h"
#include "scantet/topology/near_level.h"

namespace scantet {
namespace {

/// A place on the level set, near a node.
struct Foot {
  std::array<int, 3> node;
  std::array<double, 3> offset_mm;  ///< from the node
};

/// The foot of a node that has a neighbour on the other side. Return: whether it has.
bool find_foot(const HeightGrid& heights, const std::array<double, 3>& spacing_mm, Foot& foot) {
  const auto& [i, j, k] = foot.node;
  const double h = heights.height(i, j, k);
  const bool inside = h > 0;
  std::array<double, 3> inverse{};  // one over the signed distance of the crossing along each axis
  for (int direction = 0; direction < 6; ++direction) {
    const std::array<int, 3> next = axis_neighbor(foot.node, direction);
    const double other = heights.height(next[0], next[1], next[2]);
    if ((other > 0) == inside) continue;
    const int axis = direction / 2;
    constexpr double kLeast = 1e-6;  // of an edge: nodes at the level
    const double along = spacing_mm[axis] * std::max(kLeast, h / (h - other));
    if (1 / along > std::abs(inverse[axis])) inverse[axis] = (direction % 2 == 0 ? -1 : 1) / along;
  }
  const double sum = inverse[0] * inverse[0] + inverse[1] * inverse[1] + inverse[2] * inverse[2];
  for (int axis = 0; axis < 3; ++axis) foot.offset_mm[axis] = sum > 0 ? inverse[axis] / sum : 0;
  return sum > 0;
}

std::vector<Foot> find_feet(const HeightGrid& heights, const std::array<double, 3>& spacing_mm) {
  constexpr std::size_t kSlab = 8;  // layers
  return parallel_collect<Foot>(static_cast<std::size_t>(heights.size()[2]), kSlab,
                                [&](std::size_t begin, std::size_t end, std::vector<Foot>& feet) {
                                  visit_near_level(heights, 1, 1, static_cast<int>(begin), static_cast<int>(end),
                                                   [&](int i, int j, int k) {
                                                     Foot foot{{i, j, k}, {}};
                                                     if (std::min(i, j) < 0) return;
                                                     if (find_foot(heights, spacing_mm, foot)) feet.push_back(foot);
                                                   });
                                });
}

struct Candidate {
  float distance_mm;
  std::uint32_t node;
  std::uint32_t foot;
};

}  // namespace

std::vector<float> level_distances(const SidedNodes& nodes, const std::array<double, 3>& spacing_mm, double limit_mm) {
  const PaddedNodes& all = nodes.nodes();
  std::vector<float> distances(static_cast<std::size_t>(all.count()), static_cast<float>(limit_mm));
  const std::vector<Foot> feet = find_feet(nodes.heights(), spacing_mm);
  BucketQueue<Candidate> queue(limit_mm);  // the nearest first
  const auto offer = [&](std::int64_t n, const std::array<int, 3>& node, std::uint32_t f) {
    const Foot& foot = feet[f];
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = (foot.node[axis] - node[axis]) * spacing_mm[axis] + foot.offset_mm[axis];
      square += d * d;
    }
    const auto distance = static_cast<float>(std::sqrt(square));
    if (!(distance < distances[n])) return;
    distances[n] = distance;
    queue.push(limit_mm - distance, {distance, static_cast<std::uint32_t>(n), f});
  };
  for (std::uint32_t f = 0; f < feet.size(); ++f) offer(all.number(feet[f].node), feet[f].node, f);
  while (!queue.empty()) {
    const Candidate best = queue.pop();
    if (best.distance_mm > distances[best.node]) continue;
    const std::array<int, 3> node = all.node(best.node);
    for (const NeighborOffset& o : kNeighborhood) {
      const std::int64_t n = best.node + all.step(o);
      if (distances[n] <= best.distance_mm || nodes.inside(n) != nodes.inside(best.node)) continue;
      const std::array<int, 3> next{node[0] + o[0], node[1] + o[1], node[2] + o[2]};
      if (!all.is_padding(next)) offer(n, next, best.foot);
    }
  }
  return distances;
}

}  // namespace scantet
