#include "measure.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>

namespace scantet::bench {
namespace {

using Edge = std::pair<int, int>;
constexpr double kDegrees = 180 / std::numbers::pi;

struct Meeting {
  int facets = 0;
  Patches patches = 0;
  bool twice = false;  ///< a patch has two facets here
};

std::map<Edge, Meeting> meetings(const Refined& mesh) {
  std::map<Edge, Meeting> at;
  for (const InterfaceFacet& facet : mesh.facets) {
    for (int i = 0; i < 3; ++i) {
      Meeting& meeting = at[std::minmax(facet.vertex[i], facet.vertex[(i + 1) % 3])];
      const Patches bit = Patches{1} << facet.patch;
      ++meeting.facets;
      meeting.twice |= (meeting.patches & bit) != 0;
      meeting.patches |= bit;
    }
  }
  return at;
}

double angle_between(const Vec& a, const Vec& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * kDegrees;
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const double t = std::clamp(dot(p - a, b - a) / squared_distance(a, b), 0.0, 1.0);
  return distance(p, lerp(a, b, t));
}

/// Both ways, along samples of edges and of curves.
void measure_distances(const Arrangement& domain, const Refined& mesh, const std::vector<Edge>& edges,
                       Figures& figures) {
  constexpr int kSteps = 400, kOnEdge = 8;
  const auto point = [&](int v) { return mesh.vertices[v].point; };
  std::vector<std::pair<Point, Point>> chords;  // Of the curves.
  for (const Curve& curve : domain.curves()) {
    const int steps = curve.radius > 0 ? kSteps : 1;
    for (int i = 0; i < steps; ++i)
      chords.emplace_back(curve.at(curve.length * i / steps), curve.at(curve.length * (i + 1) / steps));
  }
  for (const auto& [v, w] : edges) {
    for (int i = 0; i <= kOnEdge; ++i) {
      const Point p = lerp(point(v), point(w), static_cast<double>(i) / kOnEdge);
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [a, b] : chords) least = std::min(least, distance_to_segment(p, a, b));
      figures.to_curve = std::max(figures.to_curve, least);
    }
  }
  for (const Curve& curve : domain.curves()) {
    for (int i = 0; i <= kSteps; ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [v, w] : edges)
        least = std::min(least, distance_to_segment(curve.at(curve.length * i / kSteps), point(v), point(w)));
      figures.from_curve = std::max(figures.from_curve, least);
    }
  }
}

void measure_curves(const Arrangement& domain, const Refined& mesh, Figures& figures) {
  const std::map<Edge, Meeting> at = meetings(mesh);
  std::map<Edge, int> segments;
  for (const CurveSegment& s : mesh.segments) segments[std::minmax(s.vertex[0], s.vertex[1])] = s.curve;
  std::vector<Edge> edges;
  for (const auto& [edge, meeting] : at) {
    const bool smooth = meeting.facets == 2 && meeting.twice;
    if (smooth) continue;
    edges.push_back(edge);
    if (!segments.contains(edge)) ++figures.stray_edges;
  }
  for (const auto& [edge, id] : segments) {
    const auto found = at.find(edge);
    const Curve& curve = domain.curves()[id];
    ++figures.segments;
    figures.held += found != at.end() && found->second.facets == curve.sheets && found->second.patches == curve.patches;
  }
  measure_distances(domain, mesh, edges, figures);
}

void measure_tets(const Refined& mesh, double size_mm, Figures& figures) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& tet : mesh.tets) {
    bool at_curve = false;
    double least = 180;
    for (int i = 0; i < 4; ++i) at_curve |= mesh.vertices[tet[i]].dimension < 2;
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        int others[2], count = 0;
        for (int k = 0; k < 4; ++k)
          if (k != i && k != j) others[count++] = tet[k];
        const Point a = mesh.vertices[tet[i]].point;
        const Vec along = mesh.vertices[tet[j]].point - a;
        const double dihedral = angle_between(cross(along, mesh.vertices[others[0]].point - a),
                                              cross(along, mesh.vertices[others[1]].point - a));
        least = std::min(least, dihedral);
        figures.largest_dihedral = std::max(figures.largest_dihedral, dihedral);
        shortest = std::min(shortest, length(along));
      }
    }
    figures.least_dihedral = std::min(figures.least_dihedral, least);
    figures.sharp += least < 10;
    figures.sharp_away += least < 10 && !at_curve;
  }
  figures.shortest = shortest / size_mm;
}

}  // namespace

Figures measure(const Arrangement& domain, const Refined& mesh, double size_mm) {
  Figures figures;
  measure_curves(domain, mesh, figures);
  measure_tets(mesh, size_mm, figures);
  for (const InterfaceFacet& facet : mesh.facets) {
    for (int i = 0; i < 3; ++i) {
      const Point &a = mesh.vertices[facet.vertex[i]].point, &b = mesh.vertices[facet.vertex[(i + 1) % 3]].point,
                  &c = mesh.vertices[facet.vertex[(i + 2) % 3]].point;
      figures.least_facet_angle = std::min(figures.least_facet_angle, angle_between(b - a, c - a));
    }
  }
  return figures;
}

}  // namespace scantet::bench
