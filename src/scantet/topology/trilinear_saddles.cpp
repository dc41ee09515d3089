// The joins come from slicing the cell at constant z. A slice is a bilinear function with corner heights a(z), b(z),
// c(z), d(z), linear in z. Each component of its inside holds a corner, and opposite corners a, d > 0 with b, c ≤ 0 are
// joined in it just where D(z) = a·d − b·c > 0 (the sign of its saddle). On each vertical edge the inside is an
// interval, and the inside of the cell is connected as these four intervals are, two of them being joined when some
// slice joins them. Walking along z, a join of neighbours begins at an end of the cell or on a vertical face, which the
// joins along edges and faces know. A join across a diagonal begins there too, unless D, a quadratic, has its extremum
// in between. So there is one extremum to look at, and no critical point to solve for. The part below is the same with
// the signs turned round. Where D = 0 all along z the field is a product, which is zero along a line where parts of
// either sign touch; there the parts below are joined. The discriminant of D is Cayley's hyperdeterminant of the eight
// heights, the same whichever axis is sliced.
#include "scantet/topology/trilinear_saddles.h"

#include <algorithm>
#include <cmath>

namespace scantet {
namespace {

/// The number of groups that the corners in `members` form along the cell's edges.
constexpr int edge_groups(unsigned members) {
  int groups = 0;
  while (members != 0) {
    unsigned group = members & (~members + 1);  // the lowest corner, then all it reaches
    for (int step = 0; step < 8; ++step) {
      unsigned grown = group;
      for (unsigned c = 0; c < 8; ++c) {
        if (group >> c & 1) grown |= 1U << (c ^ 1) | 1U << (c ^ 2) | 1U << (c ^ 4);
      }
      group = grown & members;
    }
    members &= ~group;
    ++groups;
  }
  return groups;
}

constexpr std::array<int, 4> face_corners(int axis) {
  const auto [u_axis, v_axis] = face_axes(axis);
  const int u = 1 << u_axis;
  const int v = 1 << v_axis;
  return {0, u, v, u | v};
}

constexpr std::array<std::uint8_t, 256> make_open_questions() {
  std::array<std::uint8_t, 256> table{};
  for (unsigned pattern = 0; pattern < 256; ++pattern) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::array<int, 4> f = face_corners(axis);
      const auto inside = [&](int n) { return pattern >> f[n] & 1; };
      if (inside(0) == inside(3) && inside(1) == inside(2) && inside(0) != inside(1)) table[pattern] |= 1U << axis;
    }
    if (edge_groups(pattern) > 1 || edge_groups(~pattern & 255U) > 1) table[pattern] |= kBodyOpen;
  }
  return table;
}

constexpr std::array<std::uint8_t, 256> kOpenQuestions = make_open_questions();

}  // namespace

std::uint8_t open_questions(unsigned pattern) {
  return kOpenQuestions[pattern];
}

std::array<int, 4> low_face(int axis) {
  return face_corners(axis);
}

std::array<int, 3> low_face_node(const std::array<int, 3>& cell, int axis, int n, int step) {
  const auto [u_axis, v_axis] = face_axes(axis);
  std::array<int, 3> node = cell;
  node[axis] += step;
  node[u_axis] += n & 1;
  node[v_axis] += n >> 1;
  return node;
}

Vec FaceSaddle::index(const std::array<int, 3>& cell, int axis) const {
  const auto [u_axis, v_axis] = face_axes(axis);
  Vec place{double(cell[0]), double(cell[1]), double(cell[2])};
  place[u_axis] += u;
  place[v_axis] += v;
  return place;
}

FaceSaddle face_saddle(const std::array<double, 4>& h) {
  const double twist = (h[0] - h[1]) + (h[3] - h[2]);
  return {(h[0] - h[2]) / twist, (h[0] - h[1]) / twist, (h[0] * h[3] - h[1] * h[2]) / twist, twist};
}

std::optional<std::array<int, 2>> low_face_join(const CellHeights& heights, int axis) {
  const std::array<int, 4> face = low_face(axis);
  const double ends = heights[face[0]] * heights[face[3]];
  const double others = heights[face[1]] * heights[face[2]];
  if (ends == others) return std::nullopt;
  return ends > others ? std::array{face[0], face[3]} : std::array{face[1], face[2]};
}

std::optional<std::array<int, 2>> body_join(const CellHeights& heights) {
  double largest = 0;
  for (double value : heights) largest = std::max(largest, std::abs(value));
  CellHeights h = heights;
  for (double& value : h)
    value = std::scalbn(value, -std::ilogb(largest));  // fourth powers neither over- nor underflow

  // Vertical edges: a from corner 0, b from 1, c from 2, d from 3; D(z) = A z² + B z + C.
  const std::array<double, 4> rise{h[4] - h[0], h[5] - h[1], h[6] - h[2], h[7] - h[3]};
  const double a = rise[0] * rise[3] - rise[1] * rise[2];
  const double b = (h[0] * rise[3] + h[3] * rise[0]) - (h[1] * rise[2] + h[2] * rise[1]);
  const double c = h[0] * h[3] - h[1] * h[2];
  const double denominator = 2 * std::abs(a);
  const double numerator = a > 0 ? -b : b;  // the extremum is at z = numerator / denominator
  if (!(0 < numerator && numerator < denominator)) return std::nullopt;

  // A maximum of D joins the corners a, d; a minimum b, c.
  const int first = a < 0 ? 0 : 1;
  const int second = 3 - first;
  const auto inside_at_extremum = [&](int edge) {
    return h[edge] * (denominator - numerator) + h[edge + 4] * numerator > 0;
  };
  const bool inside = inside_at_extremum(first);
  if (inside != inside_at_extremum(second)) return std::nullopt;
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant > 0)) return std::nullopt;
  const auto corner = [&](int edge) { return (h[edge] > 0) == inside ? edge : edge + 4; };
  return std::array<int, 2>{corner(first), corner(second)};
}

int line_joins(const CellHeights& h, std::array<std::array<int, 2>, 6>& out) {
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::array<int, 4> low = low_face(axis);
    std::array<int, 4> high = low;
    for (int& corner : high) corner |= 1 << axis;
    const auto saddle = [&](const std::array<int, 4>& a, const std::array<int, 4>& b) {
      return h[a[0]] * h[b[3]] - h[a[1]] * h[b[2]];
    };
    if (saddle(low, low) != 0 || saddle(high, high) != 0 || saddle(low, high) + saddle(high, low) != 0) continue;
    // D = 0: where two of the four edges change sign, the line may leave the cell or come in.
    std::array<double, 6> ends{0, 1, 1, 1, 1, 1};
    for (int n = 0; n < 4; ++n) {
      const double from = h[low[n]];
      const double to = h[high[n]];
      if (from * to < 0) ends[2 + n] = from / (from - to);
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t n = 1; n < ends.size() && count < static_cast<int>(out.size()); ++n) {
      if (ends[n] == ends[n - 1]) continue;
      const auto is_below = [&](int edge) {
        return mix(h[low[edge]], h[high[edge]], 0.5 * (ends[n - 1] + ends[n])) < 0;
      };
      const int first = is_below(0) ? 0 : 1;
      if (!is_below(first) || !is_below(3 - first) || is_below(1 - first) || is_below(2 + first)) continue;
      const auto corner = [&](int edge) { return h[low[edge]] < 0 ? low[edge] : high[edge]; };
      out[count++] = {corner(first), corner(3 - first)};
    }
  }
  return count;
}

int body_saddles(const CellHeights& h, std::array<Saddle, 2>& out) {
  // f = c0 + cx x + cy y + cz z + cxy xy + cyz yz + cxz xz + cxyz xyz
  const double cx = h[1] - h[0];
  const double cy = h[2] - h[0];
  const double cz = h[4] - h[0];
  const double cxy = (h[3] - h[2]) - cx;
  const double cyz = (h[6] - h[4]) - cy;
  const double cxz = (h[5] - h[4]) - cx;
  const double cxyz = ((h[7] - h[6]) - (h[5] - h[4])) - ((h[3] - h[2]) - (h[1] - h[0]));
  // ∂x = ∂y = 0 give x and y for each z; then ∂z = 0 is the quadratic q·cxyz z² + 2 q·cxy z + r = 0.
  const double q = cz * cxyz - cyz * cxz;
  const double square = q * cxyz;
  const double half = q * cxy;
  const double r = cxy * (cz * cxy - cx * cyz - cy * cxz) + cx * cy * cxyz;
  const double discriminant = half * half - square * r;
  if (!(discriminant >= 0)) return 0;
  const double w = -(half + std::copysign(std::sqrt(discriminant), half));
  int count = 0;
  for (double z : {w / square, r / w}) {  // not finite where the quadratic has no such root
    const double slope = cxy + cxyz * z;
    const Vec u{-(cy + cyz * z) / slope, -(cx + cxz * z) / slope, z};
    const auto within = [](double t) { return t > 0 && t < 1; };
    if (!(within(u.x) && within(u.y) && within(u.z))) continue;
    if (count == 1 && out[0].position == u) continue;  // a double root
    out[count++] = {u, trilinear(h, u), {cyz + cxyz * u.x, cxz + cxyz * u.y, slope}};
  }
  return count;
}

}  // namespace scantet
