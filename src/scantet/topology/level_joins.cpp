// Joins and walls without width do not count, for no mesh can have them. Nodes may be at the level itself; many are in
// a scan of whole numbers at a whole number. There the parts are those of {h > 0} and of {h < 0}, and nodes at the
// level are in neither. So a void whose only way out is along nodes at the level is a void of its own. Cells with such
// nodes are asked twice: as they are, for the joins above the level, and with their heights negated, for those below.
//
// Two parts may touch. Where they touch at a point they stay apart: a mesh can part them there. Along a line where the
// field is like xy, the parts above touch as well as the parts below, and only one of the two pairs can be kept apart:
// the parts below are joined. Parts that touch in a face have nothing between them and are one, above as below. A
// saddle at the level itself, between nodes that are not at it, is such a point, or a point of such a line:
// trilinear_saddles.h tells which.
#include "scantet/topology/level_joins.h"

#include <algorithm>
#include <optional>
#include <span>

#include "scantet/field/sign_patterns.h"
#include "scantet/topology/trilinear_saddles.h"

namespace scantet {
namespace {

constexpr int kKinds = 6;  // of places at a node: the edges along each axis, then the faces across each

bool has_zero(std::span<const double> heights) {
  return std::find(heights.begin(), heights.end(), 0.0) != heights.end();
}

/// Calls unite(a, b) for the joins of a cell beyond those along edges: for corners above the level; and for corners
/// below it where no corner of the face or body that joins them is at the level. open: the cell's open_questions().
/// mirrored: heights and open are of the negated field; then places without a corner at the level are left out, for
/// these have been asked before. body: the heights as they were read.
template <class Unite>
void join_cell(const CellHeights& heights, const CellHeights& body, std::uint8_t open, bool mirrored,
               const Unite& unite) {
  const auto counts = [&](std::span<const double> asked, const CellHeights& h, int a, int b) {
    return has_zero(asked) ? h[a] > 0 && h[b] > 0 : !mirrored;
  };
  for (int axis = 0; axis < 3; ++axis) {
    if ((open >> axis & 1) == 0) continue;
    const std::array<int, 4> face = low_face(axis);
    const std::array<double, 4> h{heights[face[0]], heights[face[1]], heights[face[2]], heights[face[3]]};
    const auto joined = low_face_join(heights, axis);
    if (joined && counts(h, heights, (*joined)[0], (*joined)[1])) unite((*joined)[0], (*joined)[1]);
  }
  if ((open & kBodyOpen) == 0) return;
  const auto joined = body_join(body);
  if (joined && counts(body, body, (*joined)[0], (*joined)[1])) unite((*joined)[0], (*joined)[1]);
}

/// Calls found(kind, corner, begin, end, part) for the edges and faces of a cell that are at the level. corner: a low
/// corner of the place; part: a corner in a part that reaches the place, from `begin` to `end` of it. Faces are for
/// parts above only: parts below reach their edges.
template <class Found>
void find_contacts(const CellHeights& h, const Found& found) {
  for (int axis = 0; axis < 3; ++axis) {
    const int along = 1 << axis;
    for (int low = 0; low < 8; ++low) {
      if ((low & along) != 0 || h[low] != 0 || h[low | along] != 0) continue;
      for (const int aside : {1 << (axis + 1) % 3, 1 << (axis + 2) % 3}) {
        const double a = h[low ^ aside];  // beside the edge the field has the sign of the line from a to b
        const double b = h[(low | along) ^ aside];
        if (a >= 0 && b >= 0) continue;
        const double begin = a > 0 ? a / (a - b) : 0;
        const double end = b > 0 ? a / (a - b) : 1;
        found(axis, low, begin, end, a < 0 ? low ^ aside : (low | along) ^ aside);
      }
    }
    for (const int side : {0, along}) {
      bool at_level = true;
      std::optional<int> above;
      for (int corner = 0; corner < 8; ++corner) {
        const bool on_face = (corner & along) == side;
        at_level = at_level && (!on_face || h[corner] == 0);
        if (!on_face && h[corner] > 0) above = corner;
      }
      if (at_level && above) found(3 + axis, side, 0, 1, *above);
    }
  }
}

}  // namespace

void join_cells(const HeightGrid& heights, const RunSweep& sweep, UnionFind& sets,
                std::vector<LevelContact>& contacts) {
  const int k = sweep.k() - 1;
  const RunLayer& low = sweep.layer(1);
  const RunLayer& high = sweep.layer(0);
  const bool has_zeros = low.has_zeros || high.has_zeros;
  const auto place_of = [&](int kind, int i, int j, int layer) {
    const std::int64_t row = std::int64_t{layer + 1} * (heights.size()[1] + 2) + j + 1;
    return (row * (heights.size()[0] + 2) + i + 1) * kKinds + kind;
  };
  const auto visit = [&](const SignLayer& bottom, const SignLayer& top, bool mirrored) {
    visit_mixed_cells(bottom, top, [&](int i, int j, unsigned pattern) {
      const std::uint8_t open = open_questions(pattern);
      if (open == 0 && !has_zeros) return;
      CellHeights corners = heights.corners(i, j, k);
      const auto label = [&](int corner) {
        return (corner & 4 ? high : low).label_at(i + (corner & 1), j + (corner >> 1 & 1));
      };
      if (has_zeros && has_zero(corners)) {
        find_contacts(corners, [&](int kind, int corner, double begin, double end, int part) {
          const int layer = k + (corner >> 2);
          contacts.push_back({place_of(kind, i + (corner & 1), j + (corner >> 1 & 1), layer), begin, end, label(part)});
        });
      }
      if (open == 0) return;
      CellHeights body = open & kBodyOpen ? heights.field_corners(i, j, k) : corners;
      for (CellHeights* h : {&corners, &body}) {
        for (double& height : *h) height = mirrored ? -height : height;
      }
      join_cell(corners, body, open, mirrored, [&](int a, int b) { sets.unite(label(a), label(b)); });
    });
  };
  visit(low, high, false);
  if (has_zeros) visit(low.reached, high.reached, true);
}

void join_contacts(std::vector<LevelContact>& contacts, UnionFind& sets) {
  std::sort(contacts.begin(), contacts.end());
  for (auto first = contacts.begin(); first != contacts.end();) {
    const auto last = std::upper_bound(first, contacts.end(), *first);
    for (auto a = first; a != last; ++a) {
      for (auto b = a + 1; b != last; ++b) {
        if (a->begin < b->end && b->begin < a->end) sets.unite(a->label, b->label);
      }
    }
    first = last;
  }
}

bool is_in_layer(const LevelContact& contact, const HeightGrid& heights, int k) {
  const int kind = static_cast<int>(contact.place % kKinds);
  const std::int64_t layer = contact.place / kKinds / (heights.size()[0] + 2) / (heights.size()[1] + 2) - 1;
  const bool is_across = kind == 2 || kind == 3 || kind == 4;  // an edge along z, a face across x or y
  return !is_across && layer == k;
}

}  // namespace scantet
