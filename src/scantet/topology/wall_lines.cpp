// Two bilinear functions are zero along a common curve if they are proportional, or if both are products with a common
// factor u - c or v - c. A product of u - c and v - d has a saddle at the level: there two lines cross, and from there
// a line at the level leads into the cell, on which the parts in it touch.
//
// Parts that touch along an open line are one part with it, whose Euler number is less by that of the line, which is
// -1: a line counts as 1. Its ends on the edges of the face are level_ties.cpp's. At a saddle the lines into the cells
// make all one: it counts as -1, unless the saddle's two parts are one with a part on the other side already; where
// there are two opposite saddles, as -3, for four parts.
#include "scantet/topology/wall_lines.h"

namespace scantet {
namespace {

constexpr int kOpposite = 2;  // the corner across the first

bool are_proportional(const WallHeights& a, const WallHeights& b) {
  for (int n = 0; n < 4; ++n) {
    for (int m = n + 1; m < 4; ++m) {
      if (a[n] * b[m] != a[m] * b[n]) return false;
    }
  }
  return true;
}

/// Of functions that are proportional: whether by a negative factor.
bool are_opposite(const WallHeights& a, const WallHeights& b) {
  for (int n = 0; n < 4; ++n) {
    if (a[n] * b[n] != 0) return a[n] * b[n] < 0;
  }
  return false;
}

/// Whether there is a saddle in the face, at the level.
bool has_saddle_at_level(const WallHeights& h) {
  const bool alternates = h[0] * h[1] < 0 && h[1] * h[2] < 0 && h[2] * h[3] < 0;
  return alternates && h[0] * h[2] == h[1] * h[3];
}

/// The curves on which a function without such a saddle is zero.
int zero_curves(const WallHeights& h) {
  int changes = 0;
  double last = 0;
  for (int n = 0; n < 8; ++n) {  // twice around, to begin with a sign
    if (h[n % 4] == 0) continue;
    changes += n >= 4 && h[n % 4] * last < 0 ? 1 : 0;
    last = h[n % 4];
  }
  return changes / 2;
}

/// Of functions (u - c)·p(v) and (u - c)·q(v) that are not proportional: along how many stretches of the line u = c the
/// signs of p and q are opposite, so that the parts touch. along_u, along_v: the corners beside the first one.
int common_stretches(const WallHeights& a, const WallHeights& b, int along_u, int along_v) {
  const auto factor = [&](const WallHeights& h) {  // u - c at u = 0 and 1
    const bool is_first = h[0] != 0 || h[along_u] != 0;
    return is_first ? std::array{h[0], h[along_u]} : std::array{h[along_v], h[kOpposite]};
  };
  const std::array<double, 2> first = factor(a);
  const std::array<double, 2> other = factor(b);
  if (!(first[0] * first[1] < 0) || !(other[0] * other[1] < 0) || first[0] * other[1] != first[1] * other[0]) return 0;
  int sign = 1;   // of p·q in the first stretch
  int roots = 0;  // of both together, between stretches
  for (const WallHeights& h : {a, b}) {
    if (h[0] * h[kOpposite] != h[1] * h[3]) return 0;  // no product
    const double low = h[0] * first[0];                // p or q at v = 0, but for a positive factor
    const double high = h[along_v] * first[0];
    if ((low != 0 ? low : high) < 0) sign = -sign;
    if (low * high < 0) ++roots;
  }
  return (roots + (sign < 0 ? 2 : 1)) / 2;
}

/// g at the saddle of h, which is at the level, but for a positive factor.
double value_at_saddle(const WallHeights& h, const WallHeights& g) {
  return h[0] * (h[0] * g[2] - h[1] * g[3]) - h[3] * (h[0] * g[1] - h[1] * g[0]);
}

/// Whether the curve on which g is zero leads from such a saddle, where it passes, into both parts above zero.
bool runs_through(const WallHeights& h, const WallHeights& g) {
  const double along_u = h[0] * (g[2] - g[3]) - h[3] * (g[1] - g[0]);
  const double along_v = h[0] * (g[2] - g[1]) - h[1] * (g[3] - g[0]);
  return h[0] * along_u * along_v < 0;
}

}  // namespace

int touching_lines(const WallHeights& a, const WallHeights& b) {
  if (!are_proportional(a, b)) return common_stretches(a, b, 1, 3) + common_stretches(a, b, 3, 1);
  if (!are_opposite(a, b)) return 0;
  return has_saddle_at_level(a) ? 4 : zero_curves(a);
}

int wall_line_shares(const std::array<WallHeights, 2>& beside) {
  int eighths = 8 * touching_lines(beside[0], beside[1]);
  const bool are_crosses = has_saddle_at_level(beside[0]) && has_saddle_at_level(beside[1]);
  if (are_crosses && are_proportional(beside[0], beside[1]))
    return are_opposite(beside[0], beside[1]) ? eighths - 16 : eighths;
  for (const int side : {0, 1}) {
    const WallHeights& here = beside[side];
    const WallHeights& beyond = beside[1 - side];
    if (!has_saddle_at_level(here)) continue;
    const double there = value_at_saddle(here, beyond);
    eighths += there > 0 || (there == 0 && runs_through(here, beyond)) ? 4 : -4;
  }
  return eighths;
}

}  // namespace scantet
