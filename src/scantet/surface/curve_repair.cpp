// The domain is asked at places on a circle around the middle of a piece, once: the balls stay as they are. A region
// that none of the tets around the piece is in is missed, and so is one at two places next to each other: at a single
// one a facet may turn away from its patch a little earlier.
#include <algorithm>
#include <array>
#include <cmath>

#include "scantet/base/axis_across.h"
#include "scantet/base/parallel.h"
#include "scantet/surface/curve_repair_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kGrain = 256;
constexpr double kEmpty = 0.5;  // of the circle's radius, and of the distance of its crossings
constexpr double kDiagonal = 0.70710678118654752;

/// Coordinates across a piece.
using Across = std::array<double, 2>;
constexpr std::array<Across, 8> kCircle{{{1, 0},
                                         {kDiagonal, kDiagonal},
                                         {0, 1},
                                         {-kDiagonal, kDiagonal},
                                         {-1, 0},
                                         {-kDiagonal, -kDiagonal},
                                         {0, -1},
                                         {kDiagonal, -kDiagonal}}};

double cross_of(const Across& a, const Across& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// The two vertices of a cell that are no ends of an edge of it.
std::array<PointId, 2> others_of(const Cell& cell, const std::array<PointId, 2>& ends) {
  std::array<PointId, 2> others{};
  std::copy_if(cell.vertex.begin(), cell.vertex.end(), others.begin(),
               [&](PointId v) { return v != ends[0] && v != ends[1]; });
  return others;
}

}  // namespace

std::vector<ExtraPoint> CurveRepair::points_beside() {
  const std::vector<CurvePiece>& pieces = triangulation_.junctions().pieces();
  if (circles_.size() < pieces.size()) look_around();
  auto points =
      parallel_collect<ExtraPoint>(pieces.size(), kGrain, [&](std::size_t begin, std::size_t end, auto& found) {
        std::vector<CellId> star;
        for (std::size_t i = begin; i < end; ++i) {
          if (!is_missed(pieces[i], circles_[i], star)) continue;
          for (const Point& p : circles_[i].crossings) found.push_back({p, circles_[i].clear_mm, star.front()});
        }
      });
  std::sort(points.begin(), points.end(), clearer);
  return points;
}

void CurveRepair::look_around() {
  const std::vector<CurvePiece>& pieces = triangulation_.junctions().pieces();
  circles_.resize(pieces.size());
  parallel_for(pieces.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Crossings crossings;
    for (std::size_t i = begin; i < end; ++i) circles_[i] = circle_around(pieces[i], crossings);
  });
}

CurveRepair::Circle CurveRepair::circle_around(const CurvePiece& piece, Crossings& crossings) const {
  static_assert(kSides == kCircle.size());
  const Triangulation& t = triangulation_.triangulation();
  const Point& a = t.point(piece.ends[0]);
  const Point& b = t.point(piece.ends[1]);
  Circle circle;
  const double radius_mm = std::sqrt(std::max(t.weight(piece.ends[0]), t.weight(piece.ends[1])));
  const Vec u = cross(b - a, axis_across(b - a));
  const Vec v = cross(b - a, u);
  circle.axes = {(1 / length(u)) * u, (1 / length(v)) * v};
  std::array<Point, kSides> places;
  for (std::size_t n = 0; n < kSides; ++n) {
    const Vec away = kCircle[n][0] * circle.axes[0] + kCircle[n][1] * circle.axes[1];
    places[n] = lerp(a, b, 0.5) + radius_mm * away;
  }
  domain_.regions_at(places, circle.regions);
  for (std::size_t n = 0; n < kSides; ++n) {
    domain_.crossings({places[n], places[(n + 1) % kSides]}, crossings);
    for (const Crossing& crossing : crossings) circle.crossings.push_back(crossing.point);
  }
  circle.clear_mm = kEmpty * radius_mm;
  const std::size_t count = circle.crossings.size();
  for (std::size_t n = 0; n < count && count > 1; ++n) {
    const double apart_mm = distance(circle.crossings[n], circle.crossings[(n + 1) % count]);
    circle.clear_mm = std::min(circle.clear_mm, kEmpty * apart_mm);
  }
  return circle;
}

/// Whether the piece is an edge of the triangulation, and a region of its curve is not around it where it should be.
bool CurveRepair::is_missed(const CurvePiece& piece, const Circle& circle, std::vector<CellId>& star) const {
  const Triangulation& t = triangulation_.triangulation();
  const Point& a = t.point(piece.ends[0]);
  t.star_of(piece.ends[0], star);
  std::vector<Region> missed = piece.regions;
  std::array<bool, kSides> differs{};
  bool is_edge = false;
  for (const CellId c : star) {
    const auto& vertices = t.cell(c).vertex;
    if (std::find(vertices.begin(), vertices.end(), piece.ends[1]) == vertices.end()) continue;
    is_edge = true;
    const Region region = t.info(c).region;
    std::erase(missed, region);
    if (t.has_corner(c)) continue;
    std::array<Across, 2> wedge;
    std::ranges::transform(others_of(t.cell(c), piece.ends), wedge.begin(), [&](PointId v) {
      const Vec away = t.point(v) - a;
      return Across{dot(away, circle.axes[0]), dot(away, circle.axes[1])};
    });
    if (cross_of(wedge[0], wedge[1]) < 0) std::swap(wedge[0], wedge[1]);
    for (std::size_t n = 0; n < kSides; ++n) {
      const bool is_here = cross_of(wedge[0], kCircle[n]) >= 0 && cross_of(kCircle[n], wedge[1]) >= 0;
      if (is_here && region != circle.regions[n]) differs[n] = true;
    }
  }
  if (!is_edge) return false;
  if (!missed.empty()) return true;
  for (std::size_t n = 0; n < kSides; ++n) {
    if (differs[n] && differs[(n + 1) % kSides]) return true;
  }
  return false;
}

}  // namespace scantet::engine
