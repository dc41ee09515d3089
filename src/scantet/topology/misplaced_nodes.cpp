// A group's Euler numbers are counted over the voxels, faces, edges and corners around it. Each of these is counted at
// one node of the group, so what a node adds depends on the 27 voxels around it only, and nodes are looked at side by
// side.
#include "scantet/topology/misplaced_nodes.h"

#include <algorithm>
#include <array>
#include <bit>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/base/union_find.h"
#include "scantet/topology/near_level.h"
#include "scantet/topology/nodes_within.h"

namespace scantet {
namespace {

constexpr int kReach = 2;  // voxels

using Node = std::array<int, 3>;  // z, y, x: in the order of the sweep

/// A set of the voxels around a node, bit n for kNeighborhood[n]; and the node's own.
using Voxels = std::uint32_t;
constexpr Voxels kOwn = 1U << 13;

/// A voxel, face, edge or corner of a voxel.
struct Place {
  Voxels around = 0;  ///< the voxels that have it
  int sign = 1;       ///< in an Euler number
};

/// The voxel of a node, its faces, edges and corners.
constexpr std::array<Place, 27> kPlaces = [] {
  std::array<Place, 27> places{};
  for (std::size_t p = 0; p < 27; ++p) {
    for (std::size_t n = 0; n < 27; ++n) {
      bool has_it = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int offset = kNeighborhood[n][axis];
        has_it = has_it && (offset == 0 || offset == kNeighborhood[p][axis]);
      }
      if (has_it) places[p].around |= 1U << n;
    }
    for (const int offset : kNeighborhood[p]) places[p].sign *= offset == 0 ? 1 : -1;
  }
  return places;
}();

/// How the Euler number of the inside voxels changes where a group changes sides, or a node's part of that.
struct EulerChange {
  int joined_at_corners = 0;
  int joined_at_faces = 0;
};

/// inside, group: of the voxels around a node of the group.
EulerChange change_at(Voxels inside, Voxels group) {
  EulerChange change;
  const Voxels after = inside ^ group;
  for (const Place& place : kPlaces) {
    const Voxels here = group & place.around;
    if ((here & -here) != kOwn) continue;  // counted at another node
    change.joined_at_corners += place.sign * (int{(after & place.around) != 0} - int{(inside & place.around) != 0});
    change.joined_at_faces += place.sign * (int{(~after & place.around) == 0} - int{(~inside & place.around) == 0});
  }
  return change;
}

/// Which nodes are inside.
NodeBits inside_nodes(const HeightGrid& heights) {
  NodeBits bits(heights.size());
  parallel_for(static_cast<std::size_t>(heights.size()[2]), 1, [&](std::size_t layer, std::size_t) {
    const int k = static_cast<int>(layer);
    for (int j = 0; j < heights.size()[1]; ++j) {
      if (!heights.row_signs(j, k, bits.row(j, k))) std::fill_n(bits.row(j, k), bits.words(), 0);
    }
  });
  return bits;
}

/// Which of the voxels around a node have their bits set.
Voxels voxels_around(const NodeBits& bits, const Node& n) {
  Voxels voxels = 0;
  const auto first = static_cast<std::size_t>(n[2]);  // the bit of the node before
  for (std::size_t row = 0; row < 27; row += 3) {
    const int j = n[1] + kNeighborhood[row][1];
    const int k = n[0] + kNeighborhood[row][2];
    if (std::min(j, k) < 0 || j >= bits.size()[1] || k >= bits.size()[2]) continue;
    const std::uint64_t* words = bits.row(j, k) + first / 64;
    std::uint64_t three = words[0] >> (first % 64);
    if (first % 64 > 61) three |= words[1] << (64 - first % 64);
    voxels |= static_cast<Voxels>(three & 7U) << row;
  }
  return voxels;
}

/// Nodes on the wrong side, in groups of those that touch and are on one side.
class Groups {
 public:
  /// inside: the nodes of the grid that are. wrong: ascending.
  Groups(const NodeBits& inside, const std::vector<Node>& wrong) : inside_(inside), wrong_(wrong) {}

  /// Those that count, by their first nodes; the nodes ascending.
  std::vector<std::vector<Node>> find() const;

 private:
  using Pair = std::array<std::uint32_t, 2>;

  /// Of each of the nine rows around a node, the first wrong node that may be beside it. Nodes are looked at in their
  /// order, so it only moves on.
  using Cursors = std::array<std::size_t, 9>;
  EulerChange look_at(std::uint32_t id, Cursors& cursors, std::vector<Pair>& touching) const;

  const NodeBits& inside_;
  const std::vector<Node>& wrong_;
};

/// Adds the pairs of the node and a later one of its group that touches it.
EulerChange Groups::look_at(std::uint32_t id, Cursors& cursors, std::vector<Pair>& touching) const {
  const auto [z, y, x] = wrong_[id];
  const Voxels inside = voxels_around(inside_, wrong_[id]);
  const Voxels of_its_side = (inside & kOwn) != 0 ? inside : ~inside;
  Voxels group = 0;
  for (std::size_t row = 0; row < 27; row += 3) {
    const Node first{z + kNeighborhood[row][2], y + kNeighborhood[row][1], x - 1};
    std::size_t& cursor = cursors[row / 3];
    while (cursor < wrong_.size() && wrong_[cursor] < first) ++cursor;
    const Node last{first[0], first[1], x + 1};
    for (std::size_t at = cursor; at < wrong_.size() && wrong_[at] <= last; ++at) {
      const Voxels voxel = 1U << (row + static_cast<std::size_t>(wrong_[at][2] - first[2]));
      if ((voxel & of_its_side) == 0) continue;
      group |= voxel;
      if (at > id) touching.push_back({id, static_cast<std::uint32_t>(at)});
    }
  }
  return change_at(inside, group);
}

std::vector<std::vector<Node>> Groups::find() const {
  constexpr std::size_t kGrain = 1024;
  std::vector<EulerChange> changes(wrong_.size());
  const std::vector<Pair> touching =
      parallel_collect<Pair>(wrong_.size(), kGrain, [&](std::size_t begin, std::size_t end, std::vector<Pair>& pairs) {
        Cursors cursors;
        const auto [z, y, x] = wrong_[begin];
        for (std::size_t row = 0; row < 27; row += 3) {
          const Node first{z + kNeighborhood[row][2], y + kNeighborhood[row][1], x - 1};
          cursors[row / 3] =
              static_cast<std::size_t>(std::lower_bound(wrong_.begin(), wrong_.end(), first) - wrong_.begin());
        }
        for (std::size_t id = begin; id < end; ++id) {
          changes[id] = look_at(static_cast<std::uint32_t>(id), cursors, pairs);
        }
      });
  UnionFind sets(wrong_.size());
  for (const auto& [a, b] : touching) sets.unite(a, b);
  std::vector<std::uint32_t> group_of;
  std::vector<EulerChange> of_group(sets.number_sets(group_of));
  for (std::size_t id = 0; id < wrong_.size(); ++id) {
    of_group[group_of[id]].joined_at_corners += changes[id].joined_at_corners;
    of_group[group_of[id]].joined_at_faces += changes[id].joined_at_faces;
  }
  constexpr std::uint32_t kDoesNotCount = 0xffffffff;
  std::vector<std::uint32_t> place_of(of_group.size(), kDoesNotCount);
  std::uint32_t count = 0;
  for (std::size_t g = 0; g < of_group.size(); ++g) {
    if (of_group[g].joined_at_corners != 0 && of_group[g].joined_at_faces != 0) place_of[g] = count++;
  }
  std::vector<std::vector<Node>> groups(count);
  for (std::size_t id = 0; id < wrong_.size(); ++id) {
    const std::uint32_t place = place_of[group_of[id]];
    if (place != kDoesNotCount) groups[place].push_back(wrong_[id]);
  }
  return groups;
}

/// Those of a word of a row for which some nodes not more than kReach away along each axis are inside and some are not.
std::uint64_t near_level(const NodeBits& inside, std::size_t word, int j, int k) {
  std::array<std::uint64_t, 3> some{};  // of the word before, this one and the one after
  std::array<std::uint64_t, 3> all{~std::uint64_t{0}, ~std::uint64_t{0}, ~std::uint64_t{0}};
  const auto words = static_cast<std::size_t>(inside.words());
  for (int z = k - kReach; z <= k + kReach; ++z) {
    for (int y = j - kReach; y <= j + kReach; ++y) {
      const bool is_row = std::min(y, z) >= 0 && y < inside.size()[1] && z < inside.size()[2];
      const std::uint64_t* row = is_row ? inside.row(y, z) : nullptr;
      for (std::size_t n = 0; n < 3; ++n) {
        const std::size_t w = word + n - 1;  // beyond the row like beyond all rows: outside
        const std::uint64_t bits = is_row && w < words ? row[w] : 0;
        some[n] |= bits;
        all[n] &= bits;
      }
    }
  }
  std::uint64_t any = 0;
  std::uint64_t only = ~std::uint64_t{0};
  for (int by = -kReach; by <= kReach; ++by) {
    any |= moved_word(some, 1, by, 0);
    only &= moved_word(all, 1, by, 0);
  }
  return any & ~only;
}

/// Those of the layers begin … end - 1, ascending.
std::vector<Node> wrong_nodes(const HeightGrid& heights, const NodeBits& inside, const NodeBits& in_mesh, int begin,
                              int end) {
  std::vector<Node> wrong;
  const auto& size = heights.size();
  for (int k = begin; k < end; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (std::size_t w = 0; w < static_cast<std::size_t>(inside.words()); ++w) {
        std::uint64_t differs = inside.row(j, k)[w] ^ in_mesh.row(j, k)[w];
        if (differs != 0) differs &= near_level(inside, w, j, k);
        for (; differs != 0; differs &= differs - 1) {
          const int i = static_cast<int>(64 * w) + std::countr_zero(differs) - 1;
          if (i >= 0 && i < size[0] && heights.height(i, j, k) != 0) wrong.push_back({k, j, i});
        }
      }
    }
  }
  return wrong;
}

}  // namespace

std::vector<Misplaced> misplaced_nodes(const HeightGrid& heights, const Frame& frame, const TriangleSurface& boundary,
                                       const PlaceFilter& is_asked) {
  constexpr std::size_t kSlab = 8;  // layers of nodes
  const NodeBits inside = inside_nodes(heights);
  const NodeBits in_mesh = nodes_within(boundary, frame, heights.size());
  const auto place_of = [&](const Node& n) { return frame.to_world({double(n[2]), double(n[1]), double(n[0])}); };
  const auto layers = static_cast<std::size_t>(heights.size()[2]);
  const std::vector<Node> wrong =
      parallel_collect<Node>(layers, kSlab, [&](std::size_t begin, std::size_t end, std::vector<Node>& found) {
        found = wrong_nodes(heights, inside, in_mesh, static_cast<int>(begin), static_cast<int>(end));
        if (is_asked) std::erase_if(found, [&](const Node& n) { return !is_asked(place_of(n)); });
      });
  std::vector<Misplaced> places;
  std::uint32_t group = 0;
  for (const std::vector<Node>& nodes : Groups(inside, wrong).find()) {
    for (const Node& n : nodes) {
      const Region region = heights.height(n[2], n[1], n[0]) > 0 ? 1 : kOutside;
      places.push_back({place_of(n), region, group});
    }
    ++group;
  }
  return places;
}

}  // namespace scantet
