#include "scantet/verify/prism.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scantet::verify {
namespace {

using Corners = std::array<IntervalVec, 3>;

/// Halfway between two places.
IntervalVec halfway(const IntervalVec& a, const IntervalVec& b) {
  return Interval(0.5) * (a + b);
}

/// The four triangles that the middles of the sides make.
std::array<Corners, 4> quarters(const Corners& t) {
  const IntervalVec ab = halfway(t[0], t[1]);
  const IntervalVec bc = halfway(t[1], t[2]);
  const IntervalVec ca = halfway(t[2], t[0]);
  return {Corners{t[0], ab, ca}, Corners{ab, t[1], bc}, Corners{ca, bc, t[2]}, Corners{ab, bc, ca}};
}

double extent(const Corners& t) {
  Box box;
  for (const IntervalVec& corner : t) extend(box, corner);
  const Vec d = box.extent();
  return std::max({d.x, d.y, d.z});
}

/// Calls all(cell) for the cells that a box touches, as long as it says yes. False, too, if the box leaves the field.
template <class All>
bool all_cells(const VoxelNodes& nodes, const Box& box, const All& all) {
  Cell first;
  Cell last;
  if (!cells_of(nodes, box, first, last)) return false;
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        if (!all(Cell{i, j, k})) return false;
      }
    }
  }
  return true;
}

/// Whether the cell's field has the side on its own part of a triangle. Values within the cell lie between those of its
/// corners. The Bernstein coefficients of the field on the triangle are means of the values at points that take each
/// coordinate from a corner of its own.
bool triangle_has_side(const CellValues& values, const Cell& cell, const Corners& t, int side) {
  const auto fits = [&](const Interval& sum) { return side > 0 ? sum.is_positive() : sum.is_negative(); };
  if (std::all_of(values.begin(), values.end(), fits)) return true;
  std::array<std::array<std::array<Interval, 3>, 3>, 3> f;
  std::array<std::array<Interval, 3>, 3> local;  // by axis, then corner
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t n = 0; n < 3; ++n) local[axis][n] = t[n][static_cast<int>(axis)] - cell[axis];
  }
  const auto mix = [](const Interval& a, const Interval& b, const Interval& u) { return a + u * (b - a); };
  for (std::size_t x = 0; x < 3; ++x) {
    std::array<Interval, 4> row;
    for (std::size_t n = 0; n < 4; ++n) row[n] = mix(values[2 * n], values[2 * n + 1], local[0][x]);
    for (std::size_t y = 0; y < 3; ++y) {
      const Interval low = mix(row[0], row[1], local[1][y]);
      const Interval high = mix(row[2], row[3], local[1][y]);
      for (std::size_t z = 0; z < 3; ++z) f[x][y][z] = mix(low, high, local[2][z]);
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    if (!fits(f[a][a][a])) return false;
    for (std::size_t b = 0; b < 3; ++b) {
      if (b != a && !fits(f[b][a][a] + f[a][b][a] + f[a][a][b])) return false;
    }
  }
  return fits(f[0][1][2] + f[0][2][1] + f[1][0][2] + f[1][2][0] + f[2][0][1] + f[2][1][0]);
}

bool grows_on(const VoxelNodes& nodes, const Box& box, const Corners& fibres) {
  return all_cells(nodes, box, [&](const Cell& cell) {
    const IntervalVec gradient = gradient_range(nodes.cell(cell), cell, within(box, cell));
    for (const IntervalVec& e : fibres) {
      if (!dot(e, gradient).is_positive()) return false;
    }
    return true;
  });
}

}  // namespace

Box Prism::box(double from, double to) const {
  Box box;
  for (std::size_t n = 0; n < 3; ++n) {
    extend(box, at(n, from));
    extend(box, at(n, to));
  }
  return box;
}

bool unfolds(const Prism& prism) {
  const IntervalVec p1 = prism.p[1] - prism.p[0];
  const IntervalVec p2 = prism.p[2] - prism.p[0];
  const IntervalVec e1 = prism.e[1] - prism.e[0];
  const IntervalVec e2 = prism.e[2] - prism.e[0];
  const IntervalVec constant = cross(p1, p2);
  const IntervalVec linear = cross(p1, e2) + cross(e1, p2);
  const IntervalVec square = cross(e1, e2);
  for (const IntervalVec& e : prism.e) {  // linear in the place on the facet: its corners decide
    const Interval c0 = dot(constant, e);
    const Interval c1 = dot(linear, e);
    const Interval c2 = dot(square, e);
    // Bernstein coefficients of c0 + c1·s + c2·s² on [-1, 1].
    if (!(c0 - c1 + c2).is_positive() || !(c0 - c2).is_positive() || !(c0 + c1 + c2).is_positive()) return false;
  }
  return true;
}

bool rises(const VoxelNodes& nodes, const Prism& prism, int boxes) {
  struct Piece {
    Prism prism;
    double from;
    double to;
  };
  std::vector<Piece> open{{prism, -1, 1}};
  while (!open.empty()) {
    if (--boxes < 0) return false;
    const Piece piece = open.back();
    open.pop_back();
    const Box box = piece.prism.box(piece.from, piece.to);
    if (grows_on(nodes, box, piece.prism.e)) continue;
    const Vec size = box.extent();
    if (std::max({size.x, size.y, size.z}) < 1e-3) return false;
    const double along = (piece.to - piece.from) * extent({piece.prism.e[0], piece.prism.e[1], IntervalVec(Vec{})});
    if (along > 0.7 * extent(piece.prism.p)) {
      const double middle = 0.5 * (piece.from + piece.to);
      open.push_back({piece.prism, piece.from, middle});
      open.push_back({piece.prism, middle, piece.to});
      continue;
    }
    const auto p = quarters(piece.prism.p);
    const auto e = quarters(piece.prism.e);
    for (std::size_t n = 0; n < 4; ++n) open.push_back({{p[n], e[n]}, piece.from, piece.to});
  }
  return true;
}

bool has_side(const VoxelNodes& nodes, const Prism& prism, double s, int side, int boxes) {
  std::vector<Corners> open{{prism.at(0, s), prism.at(1, s), prism.at(2, s)}};
  while (!open.empty()) {
    if (--boxes < 0) return false;
    const Corners t = open.back();
    open.pop_back();
    Box box;
    for (const IntervalVec& corner : t) extend(box, corner);
    const bool is_proved =
        all_cells(nodes, box, [&](const Cell& cell) { return triangle_has_side(nodes.cell(cell), cell, t, side); });
    if (is_proved) continue;
    if (extent(t) < 1e-3) return false;
    for (const Corners& quarter : quarters(t)) open.push_back(quarter);
  }
  return true;
}

namespace {

/// Whether n·(a + s·e) > n·(b + s·e') for all corners at both ends of a stretch of s, hence in between.
bool parts(const Prism& a, const Prism& b, const Vec& n, double from, double to) {
  const IntervalVec direction(n);
  for (const double s : {from, to}) {
    double lowest = HUGE_VAL;
    double highest = -HUGE_VAL;
    for (std::size_t c = 0; c < 3; ++c) {
      lowest = std::min(lowest, dot(direction, a.at(c, s)).lo);
      highest = std::max(highest, dot(direction, b.at(c, s)).hi);
    }
    if (!(lowest > highest)) return false;
  }
  return true;
}

bool parted(const Prism& a, const Prism& b, double from, double to) {
  const double s = 0.5 * (from + to);
  std::array<Vec, 3> p;
  std::array<Vec, 3> q;
  for (std::size_t n = 0; n < 3; ++n) {
    p[n] = a.at(n, s).middle();
    q[n] = b.at(n, s).middle();
  }
  const auto either = [&](const Vec& n) { return parts(a, b, n, from, to) || parts(b, a, n, from, to); };
  for (int axis = 0; axis < 3; ++axis) {
    Vec n;
    n[axis] = 1;
    if (either(n)) return true;
  }
  if (either((p[0] + p[1] + p[2]) - (q[0] + q[1] + q[2]))) return true;
  if (either(cross(p[1] - p[0], p[2] - p[0])) || either(cross(q[1] - q[0], q[2] - q[0]))) return true;
  for (std::size_t m = 0; m < 3; ++m) {
    for (std::size_t n = 0; n < 3; ++n) {
      if (either(cross(p[(m + 1) % 3] - p[m], q[(n + 1) % 3] - q[n]))) return true;
    }
  }
  const Vec normal_a = cross(p[1] - p[0], p[2] - p[0]);
  const Vec normal_b = cross(q[1] - q[0], q[2] - q[0]);
  for (std::size_t n = 0; n < 3; ++n) {  // for triangles in nearly one plane
    if (either(cross(normal_a, p[(n + 1) % 3] - p[n])) || either(cross(normal_b, q[(n + 1) % 3] - q[n]))) return true;
  }
  return false;
}

}  // namespace

bool stay_apart(const Prism& a, const Prism& b) {
  if (parted(a, b, -1, 1)) return true;
  for (const double from : {-1.0, -0.5, 0.0, 0.5}) {
    if (!parted(a, b, from, from + 0.5)) return false;
  }
  return true;
}

}  // namespace scantet::verify
