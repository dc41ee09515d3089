// Vertices at the same place are one here: a surface may touch itself in a point.
#include "sharp_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "triangle_grid.h"

namespace polyhedron {
namespace {

using scantet::Point;
using scantet::Vec;

constexpr double kRounding = 1e-9;  // degrees

double degrees_between(const Vec& a, const Vec& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

Vec normal_of(const Surface& surface, Surface::Face_index face) {
  const auto h = surface.halfedge(face);
  const Point a = from_cgal(surface.point(surface.source(h)));
  const Vec across = cross(from_cgal(surface.point(surface.target(h))) - a,
                           from_cgal(surface.point(surface.target(surface.next(h)))) - a);
  return (1 / length(across)) * across;
}

/// Vertices at places, and the sharp edges that meet at each.
class SharpGraph {
 public:
  SharpGraph(const Surface& surface, const MarkedEdges& marked, double degrees) : degrees_(degrees - kRounding) {
    std::map<std::array<double, 3>, std::size_t> places;
    for (const Surface::Edge_index edge : marked.edges) {
      const auto h = surface.halfedge(edge);
      std::array<std::size_t, 2> ends{};
      for (const std::size_t end : {0, 1}) {
        const Point p = from_cgal(surface.point(end == 0 ? surface.source(h) : surface.target(h)));
        const auto [place, is_new] = places.try_emplace({p.x, p.y, p.z}, points_.size());
        if (is_new) {
          points_.push_back(p);
          edges_at_.emplace_back();
        }
        ends[end] = place->second;
        edges_at_[ends[end]].push_back(ends_.size());
      }
      ends_.push_back(ends);
    }
    walked_.assign(ends_.size(), 0);
    is_given_corner_.assign(points_.size(), 0);
    for (const std::array<double, 3>& corner : marked.corners) {
      const auto place = places.find(corner);
      if (place != places.end()) is_given_corner_[place->second] = 1;
    }
  }

  SharpEdges chains() {
    SharpEdges found;
    corner_.assign(points_.size(), kNone);
    for (std::size_t v = 0; v < points_.size(); ++v) {
      if (!is_corner(v)) continue;
      corner_[v] = found.corners.size();
      found.corners.push_back({points_[v], {scantet::kOutside, 1}, {}});
    }
    for (std::size_t v = 0; v < points_.size(); ++v) {
      if (corner_[v] == kNone) continue;
      for (const std::size_t edge : edges_at_[v]) {
        if (walked_[edge] == 0) found.curves.push_back(walk(v, edge));
      }
    }
    for (std::size_t edge = 0; edge < ends_.size(); ++edge) {
      if (walked_[edge] == 0) found.curves.push_back(walk(ends_[edge][0], edge));
    }
    return found;
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  std::size_t other_end(std::size_t edge, std::size_t v) const {
    return ends_[edge][0] == v ? ends_[edge][1] : ends_[edge][0];
  }

  bool is_corner(std::size_t v) const {
    const std::vector<std::size_t>& edges = edges_at_[v];
    if (edges.size() != 2 || is_given_corner_[v] != 0) return true;
    const Vec in = points_[v] - points_[other_end(edges[0], v)];
    return degrees_between(in, points_[other_end(edges[1], v)] - points_[v]) >= degrees_;
  }

  /// From a corner to the next one; where there is none around to where it starts.
  std::shared_ptr<const scantet::Curve> walk(std::size_t start, std::size_t edge) {
    std::vector<Point> points{points_[start]};
    std::size_t v = start;
    for (;;) {
      walked_[edge] = 1;
      v = other_end(edge, v);
      points.push_back(points_[v]);
      if (v == start || corner_[v] != kNone) break;
      edge = edges_at_[v][0] == edge ? edges_at_[v][1] : edges_at_[v][0];
    }
    std::optional<std::array<std::size_t, 2>> corners;
    if (corner_[start] != kNone) corners = {corner_[start], corner_[v]};
    return std::make_shared<scantet::PolylineCurve>(std::move(points),
                                                    std::vector<scantet::Region>{1, scantet::kOutside}, corners);
  }

  double degrees_;
  std::vector<Point> points_;
  std::vector<std::vector<std::size_t>> edges_at_;  // each point
  std::vector<std::array<std::size_t, 2>> ends_;    // of each edge
  std::vector<std::size_t> corner_;                 // that each point is
  std::vector<char> walked_;                        // along each edge
  std::vector<char> is_given_corner_;               // each point
};

}  // namespace

SharpEdges chains_of(const Surface& surface, const MarkedEdges& marked, double degrees) {
  return SharpGraph(surface, marked, degrees).chains();
}

SharpEdges find_sharp_edges(const Surface& surface, double degrees) {
  MarkedEdges marked;
  for (const Surface::Edge_index edge : surface.edges()) {
    const auto h = surface.halfedge(edge);
    const Vec a = normal_of(surface, surface.face(h));
    const Vec b = normal_of(surface, surface.face(surface.opposite(h)));
    if (degrees_between(a, b) >= degrees - kRounding) marked.edges.push_back(edge);
  }
  return chains_of(surface, marked, degrees);
}

}  // namespace polyhedron
