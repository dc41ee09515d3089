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
#include "scantet/topology/wall_lines.h"
#include "scantet/topology/wall_overlap.h"

namespace scantet {
namespace {

// Of places at a node: the edges along each axis, then the faces across each, for parts above and for parts below.
constexpr int kKinds = 9;
constexpr int kFaces = 3;
constexpr int kFacesBelow = 6;

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

/// Whether two parts on the same side of the level, at the same place, are one there.
bool meet(const LevelContact& a, const LevelContact& b) {
  const auto kind = a.place % kKinds;
  if (kind < kFaces) return a.begin < b.end && b.begin < a.end;
  if (a.beside_face.is_high == b.beside_face.is_high) return false;  // in one cell, which has joined them or not
  if (do_overlap(a.beside_face, b.beside_face)) return true;
  return kind >= kFacesBelow && touching_lines(a.beside_face.beside, b.beside_face.beside) > 0;
}

/// Calls found(kind, corner, begin, end, part) for the edges of a cell that are at the level and that parts below
/// reach. corner: the low corner of the edge; part: a corner in the part, which reaches from `begin` to `end` of it.
template <class Found>
void find_edges(const CellHeights& h, const Found& found) {
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
  }
}

/// Calls found(kind, corner, beside, part) for the faces of a cell that are at the level and that parts above or below,
/// by the sign, reach. corner: the lowest of the face; part: a corner in the part.
template <class Found>
void find_faces(const CellHeights& h, int sign, const Found& found) {
  constexpr std::array<int, 4> kAround{0, 1, 3, 2};
  for (int axis = 0; axis < 3; ++axis) {
    const int along = 1 << axis;
    const std::array<int, 4> face = low_face(axis);
    for (const int side : {0, along}) {
      if (std::any_of(face.begin(), face.end(), [&](int corner) { return h[corner | side] != 0; })) continue;
      const auto across = [&](int n) { return face[kAround[n]] | (along - side); };
      WallPart part{{}, 0, side == 0};
      for (int n = 0; n < 4; ++n) part.beside[n] = sign * h[across(n)];
      for (part.corner = 0; part.corner < 4; ++part.corner) {
        if (part.beside[part.corner] > 0)
          found((sign > 0 ? kFaces : kFacesBelow) + axis, side, part, across(part.corner));
      }
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
        const auto place = [&](int kind, int corner) {
          return place_of(kind, i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
        };
        const auto add_edge = [&](int kind, int corner, double begin, double end, int part) {
          contacts.push_back({place(kind, corner), begin, end, {}, label(part)});
        };
        const auto add_face = [&](int kind, int corner, const WallPart& beside, int part) {
          contacts.push_back({place(kind, corner), 0, 1, beside, label(part)});
        };
        if (mirrored) find_edges(corners, add_edge);
        find_faces(corners, mirrored ? -1 : 1, add_face);
      }
      if (open == 0) return;
      CellHeights body = open & kBodyOpen ? heights.field_corners(i, j, k) : corners;
      if (open & kBodyOpen) {
        std::array<std::array<int, 2>, 6> joins;
        for (int n = line_joins(body, joins) - 1; n >= 0; --n) {
          const auto [a, b] = joins[n];
          if (corners[a] < 0 && corners[b] < 0) sets.unite(label(a), label(b));
        }
      }
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
        if (meet(*a, *b)) sets.unite(a->label, b->label);
      }
    }
    first = last;
  }
}

bool is_in_layer(const LevelContact& contact, const HeightGrid& heights, int k) {
  const int kind = static_cast<int>(contact.place % kKinds);
  const std::int64_t layer = contact.place / kKinds / (heights.size()[0] + 2) / (heights.size()[1] + 2) - 1;
  const bool is_across = kind == 2 || (kind >= kFaces && kind % 3 != 2);  // an edge along z, a face across x or y
  return !is_across && layer == k;
}

}  // namespace scantet
