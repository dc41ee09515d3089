// The Euler number of a union is that of its cells, less that of their faces, plus that of their edges, less that of
// their nodes: each of these meets 1, 2, 4 and 8 cells. So a cell's share is the Euler number of the part in it, less
// half of that in its six faces, plus a quarter of that in its twelve edges, less an eighth of its nodes. A cell wholly
// in the part has the share 0, so only cells of both signs are looked at.
//
// The part in an edge is a stretch, that in a face one piece or two, each contractible. The part in a cell is one piece
// for each group of corners that edges, faces or the body join; and if the body joins two groups of the other sign
// instead, there is a tunnel through the group around, and one less. A cell has at most one such join
// (trilinear_saddles.h).
//
// A saddle of a face may be at the level itself, between corners that are not. Shares are those of {h > ε}, where both
// sides of the face have their pieces apart. If the part rises from the saddle into both cells, it is a ring around it,
// which the rule of level_joins.cpp closes, for the other sign is kept apart there. If a line at the level goes on from
// the saddle into a cell, the parts below are joined along it, and only they: a share of -1 for each point of the line
// that has been counted twice, hence (lines being open) +1 for each stretch in a cell, half at each of its ends.
#include "scantet/topology/cell_euler.h"

#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "scantet/field/sign_patterns.h"
#include "scantet/topology/trilinear_saddles.h"

namespace scantet {
namespace {

constexpr int kOne = 8;  // the Euler number of a point, in eighths

/// Corners of the face across `axis`, low (side 0) or high (1), in the order of low_face().
std::array<int, 4> face_of(int axis, int side) {
  std::array<int, 4> face = low_face(axis);
  for (int& corner : face) corner |= side << axis;
  return face;
}

/// A face whose corners alternate in sign: the two that are in the part, then the two that are not. None if they do not
/// alternate. members: bit c is set if corner c is in the part.
std::optional<std::array<int, 4>> alternating(const std::array<int, 4>& face, unsigned members) {
  const auto in = [&](int n) { return members >> face[n] & 1; };
  if (in(0) != in(3) || in(1) != in(2) || in(0) == in(1)) return std::nullopt;
  return in(0) ? std::array{face[0], face[3], face[1], face[2]} : std::array{face[1], face[2], face[0], face[3]};
}

/// How a part goes on from a saddle at the level, on a face, into a cell.
enum class Beyond { rises, falls, line };

/// face: as alternating() gives it, on one side of the cell; across: its axis, as a bit.
Beyond beyond_saddle(const CellHeights& h, const std::array<int, 4>& face, int across) {
  std::array<double, 4> rise;
  for (int n = 0; n < 4; ++n) rise[n] = h[face[n] ^ across] - h[face[n]];
  const double slope = (h[face[0]] * rise[1] + h[face[1]] * rise[0]) - (h[face[2]] * rise[3] + h[face[3]] * rise[2]);
  const double bend = rise[0] * rise[1] - rise[2] * rise[3];
  const double first = slope != 0 ? slope : bend;
  return first > 0 ? Beyond::rises : first < 0 ? Beyond::falls : Beyond::line;
}

/// The corners of a cell in groups, as masks, that are joined along edges first; each of the part or of the rest.
class CornerGroups {
 public:
  explicit CornerGroups(unsigned members) {
    for (unsigned c = 0; c < 8; ++c) group_[c] = 1U << c;
    for (int c = 0; c < 8; ++c) {
      for (int axis = 1; axis < 8; axis <<= 1) {
        if ((members >> c & 1) == (members >> (c ^ axis) & 1)) join(c, c ^ axis);
      }
    }
  }
  unsigned of(int corner) const { return group_[corner]; }
  bool are_joined(int a, int b) const { return group_[a] == group_[b]; }
  void join(int a, int b) {
    const unsigned both = group_[a] | group_[b];
    for (unsigned c = 0; c < 8; ++c) {
      if (both >> c & 1) group_[c] = both;
    }
  }
  /// Whether an edge of the cell runs between two groups.
  static bool touch(unsigned a, unsigned b) {
    constexpr unsigned kLow[3] = {0x55, 0x33, 0x0F};
    unsigned beside = 0;
    for (int axis = 0; axis < 3; ++axis) {
      beside |= (a & kLow[axis]) << (1 << axis) | (a >> (1 << axis) & kLow[axis]);
    }
    return (beside & b) != 0;
  }

 private:
  std::array<unsigned, 8> group_{};
};

/// Corners, less edges and plus faces as `weights` has them, of the part of a cell's surface that has the corners of a
/// group. split: bit f is set if face f (2·axis + side) has its two corners of the part apart.
int surface_share(unsigned group, unsigned split) {
  int share = -std::popcount(group);
  for (int axis = 0; axis < 3; ++axis) {
    for (int c = 0; c < 8; ++c) {
      if ((c >> axis & 1) == 0 && (group >> c & 1 || group >> (c | 1 << axis) & 1)) share += 2;
    }
    for (int side = 0; side < 2; ++side) {
      int in_face = 0;
      for (const int c : face_of(axis, side)) in_face += static_cast<int>(group >> c & 1);
      const bool apart = (split >> (2 * axis + side) & 1) != 0;
      if (in_face > 0) share -= kOne / 2 * (apart ? in_face : 1);
    }
  }
  return share;
}

/// Of cells where nothing is open: one group.
const std::array<int, 256>& plain_shares() {
  static const std::array<int, 256> table = [] {
    std::array<int, 256> shares{};
    for (unsigned members = 1; members < 256; ++members) {
      shares[members] = kOne + surface_share(members, 0);
    }
    return shares;
  }();
  return table;
}

/// Calls add(corner, eighths) for the groups of a cell where something is open. members: the corners in the part;
/// heights: above zero there; body: as they were read, of the same sign. Return: the corners of either sign as the cell
/// joins them.
template <class Add>
CornerGroups share_open_cell(unsigned members, const CellHeights& heights, const CellHeights& body, const Add& add) {
  CornerGroups groups(members);
  unsigned split = 0;
  for (int face = 0; face < 6; ++face) {
    const auto corners = alternating(face_of(face / 2, face % 2), members);
    if (!corners) continue;
    const auto [a, b, c, d] = *corners;
    const bool joined = heights[a] * heights[b] > heights[c] * heights[d];
    groups.join(joined ? a : c, joined ? b : d);
    if (!joined) split |= 1U << face;
  }
  std::array<int, 8> share{};  // by the lowest corner of a group
  const auto first_of = [](unsigned group) { return std::countr_zero(group); };
  for (int c = 0; c < 8; ++c) {
    if ((members >> c & 1) != 0 && first_of(groups.of(c)) == c) share[c] = kOne + surface_share(groups.of(c), split);
  }
  const auto joined = body_join(body);
  if (joined && !groups.are_joined((*joined)[0], (*joined)[1])) {
    const unsigned one = groups.of((*joined)[0]);
    const unsigned other = groups.of((*joined)[1]);
    for (int c = 0; c < 8; ++c) {  // one of the two, or the group around a tunnel
      if ((members >> c & 1) == 0 || first_of(groups.of(c)) != c) continue;
      const bool around = CornerGroups::touch(groups.of(c), one) && CornerGroups::touch(groups.of(c), other);
      if (groups.of(c) == one || around) share[c] -= kOne;
    }
  }
  for (int c = 0; c < 8; ++c) {
    if (share[c] != 0) add(c, share[c]);
  }
  if (joined) groups.join((*joined)[0], (*joined)[1]);
  return groups;
}

/// Calls add(corner, eighths) for saddles at the level in the low faces of cell (i, j, k). heights_of(i, j, k): the
/// heights of a cell as they were read, above zero in the part.
template <class HeightsOf, class Add>
void share_saddles(unsigned members, const CellHeights& heights, bool above, const std::array<int, 3>& cell,
                   const HeightsOf& heights_of, const Add& add) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto low = alternating(face_of(axis, 0), members);
    if (!low) continue;
    const auto [a, b, c, d] = *low;
    const double product = heights[a] * heights[b];
    if (product == 0 || product != heights[c] * heights[d]) continue;  // nodes at the level are level_ties.cpp's
    const int across = 1 << axis;
    const Beyond up = beyond_saddle(heights_of(cell), *low, across);
    std::array<int, 3> beneath = cell;
    --beneath[axis];
    const Beyond down = beyond_saddle(heights_of(beneath), {a | across, b | across, c | across, d | across}, across);
    const int lines = (up == Beyond::line ? 1 : 0) + (down == Beyond::line ? 1 : 0);
    const bool rises = up == Beyond::rises || down == Beyond::rises;
    if (up == Beyond::rises && down == Beyond::rises) add(a, kOne);
    if (!above && lines > 0) add(a, kOne / 2 * lines - (rises ? 0 : kOne));
  }
}

/// Calls add(corner, eighths) for the cell (i, j, k). above: the part is above the level.
template <class Add>
void share_cell(const HeightGrid& grid, const std::array<int, 3>& cell, unsigned members, bool above, const Add& add) {
  const std::uint8_t open = open_questions(members);
  if (open == 0) {
    if (const int share = plain_shares()[members]; share != 0) add(std::countr_zero(members), share);
    return;
  }
  const auto turned = [&](CellHeights heights) {
    for (double& height : heights) height = above ? height : -height;
    return heights;
  };
  const auto as_read = [&](const std::array<int, 3>& c) { return turned(grid.field_corners(c[0], c[1], c[2])); };
  CellHeights heights = turned(grid.corners(cell[0], cell[1], cell[2]));
  CellHeights body = as_read(cell);
  for (int c = 0; c < 8; ++c) {  // below the level, where a cell lies in it wholly
    if ((members >> c & 1) != 0 && heights[c] == 0) heights[c] = body[c] = little_below(grid);
  }
  share_open_cell(members, heights, body, add);
  if ((open & ~kBodyOpen) != 0) share_saddles(members, heights, above, cell, as_read, add);
}

}  // namespace

CellParts cell_parts(unsigned members, const CellHeights& heights) {
  CellParts parts;
  if ((open_questions(members) & kBodyOpen) == 0) {
    parts.eighths = plain_shares()[members];
    for (int c = 0; c < 8; ++c) {
      parts.corners[c] = static_cast<std::uint8_t>((members >> c & 1) != 0 ? members : ~members);
    }
    return parts;
  }
  const auto add = [&](int, int share) { parts.eighths += share; };
  const CornerGroups groups = share_open_cell(members, heights, heights, add);
  for (int c = 0; c < 8; ++c) parts.corners[c] = static_cast<std::uint8_t>(groups.of(c));
  return parts;
}

double little_below(const HeightGrid& heights) {
  constexpr double kLittle = 1e-7;
  const double outside = std::abs(heights.height(-1, -1, -1));
  return kLittle * (outside > 0 ? outside : 1);
}

void add_cell_shares(const HeightGrid& heights, const RunSweep& sweep, std::span<const std::uint32_t> part_of,
                     std::vector<std::int64_t>& eighths) {
  const int k = sweep.k() - 1;
  const RunLayer& low = sweep.layer(1);
  const RunLayer& high = sweep.layer(0);
  const auto visit = [&](const SignLayer& bottom, const SignLayer& top, bool above) {
    visit_mixed_cells(bottom, top, [&](int i, int j, unsigned pattern) {
      const unsigned members = above ? pattern : ~pattern & 255U;
      share_cell(heights, {i, j, k}, members, above, [&](int corner, int share) {
        const RunLayer& layer = corner & 4 ? high : low;
        eighths[part_of[layer.label_at(i + (corner & 1), j + (corner >> 1 & 1))]] += share;
      });
    });
  };
  visit(low, high, true);
  visit(low.reached, high.reached, false);
}

}  // namespace scantet
