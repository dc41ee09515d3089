// The distance from one triangle is a convex function, so that on a piece it is nowhere larger than at the piece's
// corners; and the distance from a set of triangles is at most that from each, and changes by no more than the way.
#include "scantet/verify/surface_distances.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/verify/distances.h"

namespace scantet::verify {
namespace {

constexpr double kShareOfScale = 0.01;
constexpr int kMostDepth = 16;

std::vector<Box> boxes_of(const std::vector<Point>& points, const std::vector<Triangle>& triangles) {
  std::vector<Box> boxes(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const VertexId v : triangles[t]) boxes[t].extend(points[v]);
  }
  return boxes;
}

using Corners = std::array<Point, 3>;

Point middle(const Corners& t) {
  return (1.0 / 3) * (t[0] + t[1] + t[2]);
}

double longest_edge(const Corners& t) {
  return std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
}

std::array<Corners, 4> quarters(const Corners& t) {
  const Point ab = lerp(t[0], t[1], 0.5);
  const Point bc = lerp(t[1], t[2], 0.5);
  const Point ca = lerp(t[2], t[0], 0.5);
  return {{{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}}};
}

class Search {
 public:
  Search(const TriangleSet& from, const TriangleSet& to, double scale_mm)
      : from_(from),
        to_(to),
        scale_mm_(scale_mm),
        margin_mm_(1e-13 * std::max(from.largest_mm(), to.largest_mm())),
        aim_mm_(kShareOfScale * scale_mm) {}

  /// Looks at corners and middles of pieces no longer than the scale.
  void sample(std::vector<TriangleDistance>& found, const Progress& progress) {
    parallel_for(from_.count(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end && !progress.cancelled(); ++t) {
        const Corners corners = from_.corners(t);
        for (const Point& p : corners) look_at(p, found[t]);
        sample(corners, 0, found[t]);
      }
    });
    for (const TriangleDistance& d : found) aim_mm_ = std::max(aim_mm_, kSlack * d.lower_mm);
  }

  void bound(std::vector<TriangleDistance>& found, const Progress& progress) const {
    parallel_for(from_.count(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end && !progress.cancelled(); ++t) {
        found[t].upper_mm = bound(from_.corners(t), 0, found[t]) + margin_mm_;
      }
    });
  }

 private:
  static constexpr double kSlack = 1.05;

  double look_at(const Point& p, TriangleDistance& found) const {
    const double d = to_.nearest(p).distance_mm;
    if (d > found.lower_mm) {
      found.lower_mm = d;
      found.lower_place = p;
    }
    return d;
  }

  void sample(const Corners& piece, int depth, TriangleDistance& found) const {
    look_at(middle(piece), found);
    if (depth == kMostDepth / 2 || longest_edge(piece) <= scale_mm_) return;
    for (const Corners& part : quarters(piece)) sample(part, depth + 1, found);
  }

  /// No point of the piece is farther.
  double bound(const Corners& piece, int depth, TriangleDistance& found) const {
    const Point center = middle(piece);
    const TriangleSet::Nearest near = to_.nearest(center);
    if (near.distance_mm > found.lower_mm) {
      found.lower_mm = near.distance_mm;
      found.lower_place = center;
    }
    double radius = 0;
    double by_corners = 0;
    for (const Point& p : piece) {
      radius = std::max(radius, distance(p, center));
      by_corners = std::max(by_corners, to_.distance_to(near.triangle, p));
    }
    const double upper = std::min(by_corners, near.distance_mm + radius);
    if (upper <= aim_mm_ || radius <= 0.1 * aim_mm_ || depth == kMostDepth) return upper;
    double most = 0;
    for (const Corners& part : quarters(piece)) most = std::max(most, bound(part, depth + 1, found));
    return std::min(most, upper);
  }

  const TriangleSet& from_;
  const TriangleSet& to_;
  double scale_mm_;
  double margin_mm_;
  double aim_mm_;  // what is small enough
};

}  // namespace

TriangleSet::TriangleSet(const std::vector<Point>& points, std::vector<Triangle> triangles)
    : points_(points), triangles_(std::move(triangles)), tree_(boxes_of(points, triangles_)) {
  const Box& all = tree_.around();
  for (int axis = 0; axis < 3; ++axis) {
    largest_mm_ = std::max({largest_mm_, std::abs(all.min[axis]), std::abs(all.max[axis])});
  }
}

std::array<Point, 3> TriangleSet::corners(std::size_t triangle) const {
  const Triangle& t = triangles_[triangle];
  return {points_[t[0]], points_[t[1]], points_[t[2]]};
}

TriangleSet::Nearest TriangleSet::nearest(const Point& p) const {
  Nearest near;
  double least = HUGE_VAL;
  tree_.nearest2(p, 0, [&](std::uint32_t t) {
    const Corners c = corners(t);
    const double d2 = squared_distance_to(p, c[0], c[1], c[2]);
    if (d2 < least) {
      least = d2;
      near.triangle = t;
    }
    return d2;
  });
  near.distance_mm = std::sqrt(least);
  return near;
}

double TriangleSet::distance_to(std::size_t triangle, const Point& p) const {
  const Corners c = corners(triangle);
  return std::sqrt(squared_distance_to(p, c[0], c[1], c[2]));
}

std::vector<TriangleDistance> surface_distances(const TriangleSet& from, const TriangleSet& to, double scale_mm,
                                                const Progress& progress) {
  std::vector<TriangleDistance> found(from.count());
  Search search(from, to, scale_mm);
  search.sample(found, progress);
  search.bound(found, progress);
  return found;
}

}  // namespace scantet::verify
