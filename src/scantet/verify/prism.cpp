#include "scantet/verify/prism.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "scantet/verify/middles.h"

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

/// The trilinear function of a cell at points that take each coordinate from a corner of a triangle, by corners.
template <class Number>
std::array<std::array<std::array<Number, 3>, 3>, 3> values_at_corners(
    const std::array<Number, 8>& values, const std::array<std::array<Number, 3>, 3>& local) {
  const auto mix = [](const Number& a, const Number& b, const Number& u) { return a + u * (b - a); };
  std::array<std::array<std::array<Number, 3>, 3>, 3> f;
  for (std::size_t x = 0; x < 3; ++x) {
    std::array<Number, 4> row;
    for (std::size_t n = 0; n < 4; ++n) row[n] = mix(values[2 * n], values[2 * n + 1], local[0][x]);
    for (std::size_t y = 0; y < 3; ++y) {
      const Number low = mix(row[0], row[1], local[1][y]);
      const Number high = mix(row[2], row[3], local[1][y]);
      for (std::size_t z = 0; z < 3; ++z) f[x][y][z] = mix(low, high, local[2][z]);
    }
  }
  return f;
}

/// Whether all Bernstein coefficients of the function on the triangle, or multiples of them, fit.
template <class Number, class Fits>
bool coefficients_fit(const std::array<std::array<std::array<Number, 3>, 3>, 3>& f, const Fits& fits) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (!fits(f[a][a][a])) return false;
    for (std::size_t b = 0; b < 3; ++b) {
      if (b != a && !fits(f[b][a][a] + f[a][b][a] + f[a][a][b])) return false;
    }
  }
  return fits(f[0][1][2] + f[0][2][1] + f[1][0][2] + f[1][2][0] + f[2][0][1] + f[2][1][0]);
}

/// What triangle_has_side() finds, by plain numbers and a bound of all their errors; none where that does not tell.
/// With L = 1 + 2·|coordinate| at most, the function at the middles is off by L³·(off + 6·vague·most), where values are
/// known to off and coordinates to vague; its three mixes round by 9·ε·L³·most, and the sum of six of it by
/// 36·ε·L³·most.
std::optional<bool> quickly(const CellValues& values, const std::array<std::array<Interval, 3>, 3>& local, int side) {
  const Middles<8> value(values);
  std::array<std::array<double, 3>, 3> place{};
  double far = 0;
  double vague = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Middles<3> middles(local[axis]);
    place[axis] = middles.value;
    far = std::max(far, middles.most);
    vague = std::max(vague, middles.off);
  }
  const double reach = 1 + 2 * far;
  const double error =
      8 * reach * reach * reach * (value.off + value.most * (6 * vague + 16 * kUnitRoundoff)) + 0x1p-900;
  const auto f = values_at_corners(value.value, place);
  if (coefficients_fit(f, [&](double sum) { return side * sum > error; })) return true;
  if (!coefficients_fit(f, [&](double sum) { return side * sum > -error; })) return false;
  return std::nullopt;
}

/// Whether the cell's field has the side on its own part of a triangle. Values within the cell lie between those of its
/// corners. The Bernstein coefficients of the field on the triangle are means of the values at points that take each
/// coordinate from a corner of its own.
bool triangle_has_side(const CellValues& values, const Cell& cell, const Corners& t, int side) {
  const auto fits = [&](const Interval& sum) { return side > 0 ? sum.is_positive() : sum.is_negative(); };
  if (std::all_of(values.begin(), values.end(), fits)) return true;
  std::array<std::array<Interval, 3>, 3> local;  // by axis, then corner
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t n = 0; n < 3; ++n) local[axis][n] = t[n][static_cast<int>(axis)] - cell[axis];
  }
  if (const auto known = quickly(values, local, side)) return *known;
  return coefficients_fit(values_at_corners(values, local), fits);
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

/// How much the field grows along the fibre in the middle of a stretch of the prism, to rounding.
double rise_in_the_middle(const VoxelNodes& nodes, const Prism& prism, double s) {
  Vec fibre;
  Vec place;
  for (std::size_t n = 0; n < 3; ++n) {
    fibre = fibre + (1.0 / 3) * prism.e[n].middle();
    place = place + (1.0 / 3) * prism.p[n].middle();
  }
  place = place + s * fibre;
  constexpr double kStep = 1e-4;  // of the fibre
  return sampled_value(nodes, place + kStep * fibre) - sampled_value(nodes, place - kStep * fibre);
}

/// Whether the field has another side than that in the middle of a triangle, to rounding.
bool lacks_side_in_the_middle(const VoxelNodes& nodes, const Corners& t, int side) {
  return side * sampled_value(nodes, (1.0 / 3) * (t[0].middle() + t[1].middle() + t[2].middle())) < 0;
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
    double rise = 0;
  };
  std::vector<Piece> open{{prism, -1, 1}};
  const auto steepest_first = [](const Piece& a, const Piece& b) { return a.rise > b.rise; };
  while (!open.empty()) {
    if (--boxes < 0) return false;
    const Piece piece = open.back();
    open.pop_back();
    const Box box = piece.prism.box(piece.from, piece.to);
    if (grows_on(nodes, box, piece.prism.e)) continue;
    const Vec size = box.extent();
    if (std::max({size.x, size.y, size.z}) < 1e-3) return false;
    const std::size_t before = open.size();
    const double along = (piece.to - piece.from) * extent({piece.prism.e[0], piece.prism.e[1], IntervalVec(Vec{})});
    if (along > 0.7 * extent(piece.prism.p)) {
      const double middle = 0.5 * (piece.from + piece.to);
      open.push_back({piece.prism, piece.from, middle});
      open.push_back({piece.prism, middle, piece.to});
    } else {
      const auto p = quarters(piece.prism.p);
      const auto e = quarters(piece.prism.e);
      for (std::size_t n = 0; n < 4; ++n) open.push_back({{p[n], e[n]}, piece.from, piece.to});
    }
    for (std::size_t n = before; n < open.size(); ++n) {
      open[n].rise = rise_in_the_middle(nodes, open[n].prism, 0.5 * (open[n].from + open[n].to));
      if (open[n].rise < 0) return false;
    }
    // Where it grows least it is looked at next: what is hopeless shows soon.
    std::sort(open.begin() + static_cast<std::ptrdiff_t>(before), open.end(), steepest_first);
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
    if (lacks_side_in_the_middle(nodes, t, side) || extent(t) < 1e-3) return false;
    for (const Corners& quarter : quarters(t)) open.push_back(quarter);
  }
  return true;
}

namespace {

/// The corners of two prisms at both ends of a stretch of s, in plain numbers: each coordinate is known to `off`, and
/// none is larger than `most`.
struct Ends {
  Ends(const Prism& a, const Prism& b, double from, double to) {
    for (std::size_t n = 0; n < 12; ++n) {
      const IntervalVec p = (n < 6 ? a : b).at(n % 3, n % 6 < 3 ? from : to);
      for (int axis = 0; axis < 3; ++axis) {
        off = std::max(off, p[axis].hi - p[axis].lo);
        most = std::max(most, p[axis].magnitude());
      }
      places[n] = p.middle();
    }
  }

  /// Whether the corners of one are all farther along n than the other's, at both ends of the stretch, hence in
  /// between.
  bool are_parted_along(const Vec& n) const {
    // The product of two vectors rounds by no more than 3·ε of the sum of its terms' magnitudes.
    const double error = (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)) * (off + 4 * kUnitRoundoff * most) + 0x1p-900;
    bool a_is_farther = true;
    bool b_is_farther = true;
    for (std::size_t end = 0; end < 2; ++end) {
      const auto extremes = [&](std::size_t first) {
        return std::minmax({dot(n, places[first]), dot(n, places[first + 1]), dot(n, places[first + 2])});
      };
      const auto a = extremes(3 * end);
      const auto b = extremes(3 * end + 6);
      a_is_farther = a_is_farther && a.first - b.second > 3 * error;
      b_is_farther = b_is_farther && b.first - a.second > 3 * error;
    }
    return a_is_farther || b_is_farther;
  }

  std::array<Vec, 12> places;  // of a, then b; three at the beginning of the stretch, three at its end
  double off = 0;
  double most = 0;
};

bool parted(const Prism& a, const Prism& b, double from, double to) {
  const double s = 0.5 * (from + to);
  std::array<Vec, 3> p;
  std::array<Vec, 3> q;
  for (std::size_t n = 0; n < 3; ++n) {
    p[n] = a.at(n, s).middle();
    q[n] = b.at(n, s).middle();
  }
  const Ends ends(a, b, from, to);
  for (int axis = 0; axis < 3; ++axis) {
    Vec n;
    n[axis] = 1;
    if (ends.are_parted_along(n)) return true;
  }
  const Vec normal_a = cross(p[1] - p[0], p[2] - p[0]);
  const Vec normal_b = cross(q[1] - q[0], q[2] - q[0]);
  if (ends.are_parted_along((p[0] + p[1] + p[2]) - (q[0] + q[1] + q[2]))) return true;
  if (ends.are_parted_along(normal_a) || ends.are_parted_along(normal_b)) return true;
  for (std::size_t m = 0; m < 3; ++m) {
    for (std::size_t n = 0; n < 3; ++n) {
      if (ends.are_parted_along(cross(p[(m + 1) % 3] - p[m], q[(n + 1) % 3] - q[n]))) return true;
    }
  }
  for (std::size_t n = 0; n < 3; ++n) {  // for triangles in nearly one plane
    if (ends.are_parted_along(cross(normal_a, p[(n + 1) % 3] - p[n]))) return true;
    if (ends.are_parted_along(cross(normal_b, q[(n + 1) % 3] - q[n]))) return true;
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
