// The trilinear function of a box is an affine one up to a bound. So the surface keeps within a slab between two
// planes, and within the hull of what this slab and the box have in common. Rounding is not accounted for: it is some
// ulps of a coordinate.
#include <algorithm>
#include <cmath>

#include "scantet/check/boundary_box_impl.h"

namespace scantet {
namespace {

constexpr std::array<std::array<int, 2>, 12> kEdges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

constexpr double kRounding = 1e-9;  // far more than it is

Vec unit_corner(int corner) {
  return {double(corner & 1), double(corner >> 1 & 1), double(corner >> 2)};
}

/// Where the height changes its sign between two points where it has different ones: false position, an end that stays
/// twice in a row counts for half (the Illinois method).
Vec sign_change(const CellHeights& h, const Vec& a, double at_a, const Vec& b, double at_b) {
  constexpr int kSteps = 60;
  constexpr double kClose = 1e-12;
  const double even = kClose * (std::abs(at_a) + std::abs(at_b));
  double low = 0;
  double high = 1;
  double at_low = at_a;
  double at_high = at_b;
  double change = 0;
  int moved = 0;  // the end that did last, by its sign
  for (int step = 0; step < kSteps && high - low > kClose; ++step) {
    change = low + (high - low) * (at_low / (at_low - at_high));
    const double height = trilinear(h, lerp(a, b, change));
    if (std::abs(height) <= even) break;
    if ((height > 0) == (at_a > 0)) {
      low = change, at_low = height;
      if (moved < 0) at_high *= 0.5;
      moved = -1;
    } else {
      high = change, at_high = height;
      if (moved > 0) at_low *= 0.5;
      moved = 1;
    }
  }
  return lerp(a, b, change);
}

}  // namespace

BoundaryBox::BoundaryBox(const BoundaryCell& cell) : cell_(&cell), size_(1), heights_(cell.heights) {
  const auto& e = cell.edges;
  const double volume = dot(e[0], cross(e[1], e[2]));
  across_ = {1 / volume * cross(e[1], e[2]), 1 / volume * cross(e[2], e[0]), 1 / volume * cross(e[0], e[1])};
  double longest = 0;
  for (const double y : {-1.0, 1.0}) {
    for (const double z : {-1.0, 1.0}) longest = std::max(longest, squared_length(e[0] + y * e[1] + z * e[2]));
  }
  cell_half_diagonal_mm_ = 0.5 * std::sqrt(longest);
  const auto is_right = [](const Vec& u, const Vec& v) {
    return std::abs(dot(u, v)) <= kRounding * length(u) * length(v);
  };
  right_angled_ = is_right(e[0], e[1]) && is_right(e[1], e[2]) && is_right(e[2], e[0]);
}

Point BoundaryBox::Hull::middle() const {
  Point sum;
  for (std::size_t i = 0; i < count; ++i) sum = sum + points[i];
  return 1.0 / static_cast<double>(count) * sum;
}

double BoundaryBox::Hull::farthest_mm(const Point& p) const {
  double squared = 0;
  for (std::size_t i = 0; i < count; ++i) squared = std::max(squared, squared_distance(points[i], p));
  return std::sqrt(squared);
}

bool BoundaryBox::may_hold(const BoundaryCells& cells, std::size_t surface) const {
  if (!has_both_signs(heights_)) return false;
  return !cell_->shared || cells.may_hold(surface, *cell_, low_, high());
}

// Between the middle of where the surface meets the box's edges, and a corner on the other side of it.
std::optional<Point> BoundaryBox::witness(const BoundaryCells& cells, std::size_t surface) const {
  Vec sum;
  int count = 0;
  for (const auto& [a, b] : kEdges) {
    const double from = heights_[static_cast<std::size_t>(a)];
    const double to = heights_[static_cast<std::size_t>(b)];
    if ((from > 0) == (to > 0)) continue;
    sum = sum + lerp(unit_corner(a), unit_corner(b), from / (from - to));
    ++count;
  }
  if (count == 0) return std::nullopt;
  const Vec middle = 1.0 / count * sum;
  const double at_middle = trilinear(heights_, middle);
  int across = -1;
  double least = 0;
  for (int corner = 0; corner < 8; ++corner) {
    if ((heights_[static_cast<std::size_t>(corner)] > 0) == (at_middle > 0)) continue;
    const double squared = squared_length(unit_corner(corner) - middle);
    if (across < 0 || squared < least) across = corner, least = squared;
  }
  if (across < 0) return std::nullopt;
  const Vec unit = at_middle == 0 ? middle
                                  : sign_change(heights_, middle, at_middle, unit_corner(across),
                                                heights_[static_cast<std::size_t>(across)]);
  const Vec local = low_ + size_ * unit;
  if (cell_->shared && !cells.may_hold(surface, *cell_, local, local)) return std::nullopt;
  return to_world(local);
}

BoundaryBox::Hull BoundaryBox::hull() const {
  const AffineBounds bounds(heights_);
  const double bent = bounds.bent();
  CellHeights flat;  // the affine part at the corners
  Hull hull;
  const auto add = [&](const Vec& unit) { hull.points[hull.count++] = to_world(low_ + size_ * unit); };
  for (int corner = 0; corner < 8; ++corner) {
    const Vec u = unit_corner(corner);
    double& height = flat[static_cast<std::size_t>(corner)];
    height = bounds.affine_at(u);
    if (std::abs(height) <= bent) add(u);
  }
  for (const auto& [a, b] : kEdges) {
    const double from = flat[static_cast<std::size_t>(a)];
    const double to = flat[static_cast<std::size_t>(b)];
    for (const double plane : {-bent, bent}) {
      if ((from > plane) != (to > plane)) add(lerp(unit_corner(a), unit_corner(b), (plane - from) / (to - from)));
    }
  }
  const bool missed = hull.count == 0;  // by rounding
  for (int corner = 0; missed && corner < 8; ++corner) add(unit_corner(corner));
  return hull;
}

BoundaryBox BoundaryBox::part(int corner) const {
  BoundaryBox half = *this;
  half.size_ = 0.5 * size_;
  half.low_ = low_ + half.size_ * unit_corner(corner);
  const Vec low = 0.5 * unit_corner(corner);
  half.heights_ = heights_between(heights_, low, low + Vec{0.5, 0.5, 0.5});
  return half;
}

// At least as far as from the ball around the box, from the slab that the surface is in, and from the slabs between
// opposite faces, whose distances add up like coordinates where all angles are right.
double BoundaryBox::least_distance_mm(const Point& p) const {
  const Vec off = p - to_world(low_);
  const Vec local{dot(off, across_[0]), dot(off, across_[1]), dot(off, across_[2])};  // shares of the cell's edges
  double most = 0;
  double squares = 0;
  for (int n = 0; n < 3; ++n) {
    const double gap =
        std::max(std::max(-local[n], local[n] - size_), 0.0) / length(across_[static_cast<std::size_t>(n)]);
    most = std::max(most, gap);
    squares += gap * gap;
  }
  const AffineBounds flat(heights_);
  const Vec slope = 2 / size_ * flat.slope();  // per share of an edge
  const Vec gradient = slope.x * across_[0] + slope.y * across_[1] + slope.z * across_[2];
  const double norm = length(gradient);
  const double height = flat.mean() + dot(slope, local) - dot(flat.slope(), {1, 1, 1});
  const double off_slab = norm > 0 ? (std::abs(height) - flat.bent()) / norm : 0;
  const double by_ball = distance(p, center()) - half_diagonal_mm();
  return (1 - kRounding) * std::max({by_ball, right_angled_ ? std::sqrt(squares) : most, off_slab, 0.0});
}

}  // namespace scantet
