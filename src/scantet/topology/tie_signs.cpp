// Of either sign there is one piece in an octant at most, for there h is, to leading order, linear in the coordinates,
// or in their inverses, or is their product. The sign at a pole is that of the neighbour there; on an arc, where both
// poles are at the level, that of the node across the face; and so on.
#include "scantet/topology/tie_signs.h"

namespace scantet {

Pieces Around::pieces(int q) const {
  Pieces pieces;
  for (int n = 0; n < 4; ++n) {
    const int next = beside[(n + 1) % 4];
    if (beside[n] == q || next == q || (beside[n] == 0 && next == 0 && between[n] == q)) pieces.add(n);
  }
  for (int n = 0; n < 4; ++n) {
    const int last = (n + 3) % 4;
    if (beside[n] == q) pieces.correct(n, -8);
    if (beside[n] == q || (beside[n] == 0 && pieces.exists(n) && pieces.exists(last))) pieces.join(n, last);
  }
  if (q < 0 && pieces.count() > 1) pieces.join_all();
  return pieces;
}

Signs::Step Signs::step(int octant, int axes) {
  Step step{};
  for (int axis = 0; axis < 3; ++axis) {
    if (axes >> axis & 1) step[axis] = octant >> axis & 1 ? 1 : -1;
  }
  return step;
}

int Signs::axes_of(int octant, int q) const {
  const auto sign = [&](int axes) { return at(step(octant, axes)); };
  for (const int axes : {1, 2, 4}) {
    if (sign(axes) == q) return axes;
  }
  for (const int axes : {3, 5, 6}) {
    if (sign(axes) != q) continue;
    const int low = axes & -axes;
    if (sign(low) == 0 && sign(axes ^ low) == 0) return axes;
  }
  for (int axes = 1; axes < 7; ++axes) {
    if (sign(axes) != 0) return 0;
  }
  return sign(7) == q ? 7 : 0;
}

Pieces Signs::pieces(int q) const {
  Pieces pieces;
  for (int octant = 0; octant < 8; ++octant) {
    if (axes_of(octant, q) != 0) pieces.add(octant);
  }
  for (int third = 1; third < 8; third <<= 1) {
    for (int octant = 0; octant < 8; ++octant) {
      if ((octant & third) == 0) join_over_arc(octant, third, q, pieces);
    }
    for (const int side : {0, third}) {
      if (at(step(side, third)) == q) pieces.correct(side, 8);
    }
  }
  for (int axis = 0; q < 0 && axis < 3; ++axis) {
    for (const int side : {0, 1}) join_at_pole(axis, side, pieces);
  }
  return pieces;
}

/// Joins an octant, on the low side of an arc, with that on the high side.
void Signs::join_over_arc(int octant, int third, int q, Pieces& pieces) const {
  const int both = 7 ^ third;
  const int u = both & -both;
  const int v = both ^ u;
  const int a = at(step(octant, u));
  const int b = at(step(octant, v));
  const int d = at(step(octant, both));
  if (a == q || b == q || (a == 0 && b == 0 && d == q)) {
    pieces.correct(octant, -8);
    pieces.join(octant, octant | third);
    return;
  }
  if (a != 0 || b != 0 || d != 0) return;
  const int reached = reach(octant, u, v, q);
  const int beyond = reach(octant | third, u, v, q);
  if ((reached & beyond) != 0) {
    pieces.join(octant, octant | third);
  } else if ((reached | beyond) == 3 && reached != 3 && beyond != 3) {  // they reach for each other from either end
    const int overlap = overlap_of(reached == 1 ? octant : octant | third, u, v, q);
    if (overlap > 0 || (overlap == 0 && q < 0)) pieces.join(octant, octant | third);
    if (overlap == 0 && q < 0 && third == across_) pieces.correct(octant, -4);  // a line goes on into the cell
  }
}

/// Whether what has the sign q in an octant, and reaches the arc at its end at u, overlaps on the arc with what reaches
/// it at its other end beyond: 1. 0: they touch along a line; -1: what has the other sign overlaps.
int Signs::overlap_of(int octant, int u, int v, int q) const {
  const int third = 7 ^ u ^ v;
  if (third == across_) return 0;
  const auto heights = [&](int from) {  // of x·h[0] + y·h[1] + x·y·h[2], x along u, y along v
    const double at_u = q * height_at_(from, third | u);
    const double at_v = q * height_at_(from, third | v);
    return std::array{at_u, at_v, q * height_at_(from, 7) - at_u - at_v};
  };
  const std::array<double, 3> here = heights(octant);
  const std::array<double, 3> there = heights(octant ^ third);
  double overlap = here[0] * there[1] - here[1] * there[0];
  if (overlap == 0) overlap = here[0] * there[2] - there[0] * here[2];
  return overlap > 0 ? 1 : overlap < 0 ? -1 : 0;
}

/// Which ends of an arc at the level what has the sign q reaches in the octant: bit 0 that at u, bit 1 that at v.
int Signs::reach(int octant, int u, int v, int q) const {
  const int third = 7 ^ u ^ v;
  const auto sign = [&](int axes) { return at(step(octant, axes)); };
  if (sign(third) != 0) return sign(third) == q ? 3 : 0;
  const int near_u = sign(third | u);
  const int near_v = sign(third | v);
  if (near_u == 0 && near_v == 0) return sign(7) == q ? 3 : 0;
  return (near_u == q || (near_u == 0 && near_v == q) ? 1 : 0) | (near_v == q || (near_v == 0 && near_u == q) ? 2 : 0);
}

/// Joins parts below that touch along an edge at the level.
void Signs::join_at_pole(int axis, int side, Pieces& pieces) const {
  const int pole = side << axis;
  if (at(step(pole, 1 << axis)) != 0) return;
  const int u = 1 << (axis + 1) % 3;
  const int v = 1 << (axis + 2) % 3;
  const std::array<int, 4> octants{pole | u | v, pole | v, pole, pole | u};
  const std::array<int, 4> beyond{u, v, u, v};  // of each octant, the direction that it begins with
  Around around{};
  for (int n = 0; n < 4; ++n) {
    const int near = at(step(octants[n], beyond[n]));
    around.beside[n] = near != 0 ? near : at(step(octants[n], beyond[n] | 1 << axis));
    const int across = at(step(octants[n], u | v));
    around.between[n] = across != 0 ? across : at(step(octants[n], 7));
  }
  const Pieces found = around.pieces(-1);
  if (found.count() != 1) return;
  int first = -1;
  for (int n = 0; n < 4; ++n) {
    if (!found.exists(n) || !pieces.exists(octants[n])) continue;
    if (first < 0) first = octants[n];
    pieces.join(first, octants[n]);
  }
}

}  // namespace scantet
