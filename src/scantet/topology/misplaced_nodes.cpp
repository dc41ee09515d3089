// A group's Euler numbers are counted over the voxels, faces, edges and corners around it, in coordinates that are
// doubled: each of these has one place there, and voxels are where all three are even.
#include "scantet/topology/misplaced_nodes.h"

#include <algorithm>
#include <array>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/topology/near_level.h"

namespace scantet {
namespace {

constexpr int kReach = 2;  // voxels

using Node = std::array<int, 3>;  // z, y, x: in the order of the sweep

class Groups {
 public:
  /// wrong: ascending.
  Groups(const HeightGrid& heights, const std::vector<Node>& wrong) : heights_(heights), wrong_(wrong) {}

  /// Those that count.
  std::vector<std::vector<Node>> find() {
    std::vector<std::vector<Node>> groups;
    std::vector<bool> known(wrong_.size());
    for (std::size_t first = 0; first < wrong_.size(); ++first) {
      if (known[first]) continue;
      collect(first, known);
      if (changes_both_euler_numbers()) groups.push_back(group_);
    }
    return groups;
  }

 private:
  bool is_inside(const Node& n) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (n[2 - axis] < 0 || n[2 - axis] >= heights_.size()[axis]) return false;
    }
    return heights_.height(n[2], n[1], n[0]) > 0;
  }
  bool is_in_group(const Node& n) const { return std::binary_search(group_.begin(), group_.end(), n); }

  void collect(std::size_t first, std::vector<bool>& known);
  bool changes_both_euler_numbers() const;

  const HeightGrid& heights_;
  const std::vector<Node>& wrong_;
  std::vector<Node> group_;  // ascending
};

void Groups::collect(std::size_t first, std::vector<bool>& known) {
  const bool inside = is_inside(wrong_[first]);
  group_.assign(1, wrong_[first]);
  known[first] = true;
  for (std::size_t n = 0; n < group_.size(); ++n) {
    for (const NeighborOffset& offset : kNeighborhood) {
      const Node other{group_[n][0] + offset[2], group_[n][1] + offset[1], group_[n][2] + offset[0]};
      const auto found = std::lower_bound(wrong_.begin(), wrong_.end(), other);
      if (found == wrong_.end() || *found != other) continue;
      const auto id = static_cast<std::size_t>(found - wrong_.begin());
      if (known[id] || is_inside(other) != inside) continue;
      known[id] = true;
      group_.push_back(other);
    }
  }
  std::sort(group_.begin(), group_.end());
}

bool Groups::changes_both_euler_numbers() const {
  std::vector<Node> places;
  for (const Node& n : group_) {
    for (const NeighborOffset& offset : kNeighborhood) {
      places.push_back({2 * n[0] + offset[2], 2 * n[1] + offset[1], 2 * n[2] + offset[0]});
    }
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  int joined_at_corners = 0;
  int joined_at_faces = 0;
  for (const Node& p : places) {
    std::array<bool, 2> some{false, false};  // before, after
    std::array<bool, 2> all{true, true};
    for (int corner = 0; corner < 8; ++corner) {  // the voxels around, some more than once
      const Node n{(p[0] + (corner & 1)) >> 1, (p[1] + (corner >> 1 & 1)) >> 1, (p[2] + (corner >> 2)) >> 1};
      const bool before = is_inside(n);
      const std::array<bool, 2> inside{before, before != is_in_group(n)};
      for (std::size_t when = 0; when < 2; ++when) {
        some[when] = some[when] || inside[when];
        all[when] = all[when] && inside[when];
      }
    }
    const int sign = ((p[0] ^ p[1] ^ p[2]) & 1) == 0 ? 1 : -1;
    joined_at_corners += sign * (int{some[1]} - int{some[0]});
    joined_at_faces += sign * (int{all[1]} - int{all[0]});
  }
  return joined_at_corners != 0 && joined_at_faces != 0;
}

/// Those of the layers begin … end - 1.
std::vector<Node> wrong_nodes(const HeightGrid& heights, const Frame& frame, const RegionProbe& mesh, int begin,
                              int end) {
  std::vector<Node> nodes;
  std::vector<Point> points;
  visit_near_level(heights, kReach, kReach, begin, end, [&](int i, int j, int k) {
    if (std::min({i, j}) < 0) return;
    nodes.push_back({k, j, i});
    points.push_back(frame.to_world({double(i), double(j), double(k)}));
  });
  std::vector<Region> regions(points.size());
  mesh(points, regions);
  std::vector<Node> wrong;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const double h = heights.height(nodes[n][2], nodes[n][1], nodes[n][0]);
    if (h != 0 && (h > 0) != (regions[n] != kOutside)) wrong.push_back(nodes[n]);
  }
  return wrong;
}

}  // namespace

std::vector<Misplaced> misplaced_nodes(const HeightGrid& heights, const Frame& frame, const RegionProbe& mesh) {
  constexpr std::size_t kSlab = 8;  // layers of nodes
  const auto layers = static_cast<std::size_t>(heights.size()[2]);
  const std::vector<Node> wrong =
      parallel_collect<Node>(layers, kSlab, [&](std::size_t begin, std::size_t end, std::vector<Node>& found) {
        found = wrong_nodes(heights, frame, mesh, static_cast<int>(begin), static_cast<int>(end));
      });
  std::vector<Misplaced> places;
  std::uint32_t group = 0;
  for (const std::vector<Node>& nodes : Groups(heights, wrong).find()) {
    for (const Node& n : nodes) {
      const Region region = heights.height(n[2], n[1], n[0]) > 0 ? 1 : kOutside;
      places.push_back({frame.to_world({double(n[2]), double(n[1]), double(n[0])}), region, group});
    }
    ++group;
  }
  return places;
}

}  // namespace scantet
