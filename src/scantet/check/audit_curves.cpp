// A mesh follows a curve of its domain if the boundary vertices that lie on it, in their order along it, are joined by
// edges of boundary facets, from end to end, or all around.
#include <algorithm>
#include <cmath>
#include <set>

#include "scantet/base/point_grid_impl.h"
#include "scantet/check/audit_impl.h"

namespace scantet::auditing {
namespace {

using Edge = std::pair<VertexId, VertexId>;

struct OnCurve {
  double along_mm;
  VertexId vertex;
};

/// The vertices on the boundary, to be asked for those on a curve.
class BoundaryVertices {
 public:
  /// step_mm: at which a curve is looked at; any, about the length of an edge is quickest.
  BoundaryVertices(const TetMesh& mesh, const std::vector<VertexId>& vertices, double step_mm)
      : vertices_(vertices), step_mm_(step_mm) {
    std::vector<Point> points;
    points.reserve(vertices.size());
    for (const VertexId v : vertices) points.push_back(mesh.vertices[v]);
    grid_ = PointGrid(points, step_mm);
  }

  /// Calls visit(vertex, point) for all that are within a distance of the curve, and for others near it; each once.
  template <class Visit>
  void each_near(const Curve& curve, double within_mm, const Visit& visit) const {
    std::set<std::uint32_t> seen;
    const double steps = std::ceil(curve.length_mm() / step_mm_);
    for (double k = 0; k <= steps; ++k) {
      // No point of the curve is farther than half a step along it from one that is looked at.
      const Point p = curve.at(curve.length_mm() * k / steps);
      grid_.any_near(p, step_mm_ + within_mm, [&](std::uint32_t i, const Point& q, double) {
        if (seen.insert(i).second) visit(vertices_[i], q);
        return false;
      });
    }
  }

 private:
  const std::vector<VertexId>& vertices_;
  double step_mm_;
  PointGrid grid_;
};

std::vector<OnCurve> vertices_on(const Curve& curve, const BoundaryVertices& boundary, double within_mm) {
  std::vector<OnCurve> found;
  boundary.each_near(curve, within_mm, [&](VertexId v, const Point& p) {
    const Curve::Nearest nearest = curve.nearest(p);
    if (nearest.distance_mm <= within_mm) found.push_back({nearest.along_mm, v});
  });
  std::sort(found.begin(), found.end(), [](const OnCurve& a, const OnCurve& b) {
    return a.along_mm != b.along_mm ? a.along_mm < b.along_mm : a.vertex < b.vertex;
  });
  return found;
}

std::set<Edge> edges_of(const FaceMatch& match) {
  std::set<Edge> edges;
  for (const BoundaryFace& face : match.boundary) {
    const auto& v = face.vertices;  // ascending
    edges.insert({{v[0], v[1]}, {v[0], v[2]}, {v[1], v[2]}});
  }
  return edges;
}

std::string name_of(const Curve& curve, std::size_t index) {
  return curve.name().empty() ? named("curve", index) : curve.name();
}

}  // namespace

void check_curves(const TetMesh& mesh, const FaceMatch& match, const std::vector<VertexId>& boundary,
                  const Domain& domain, AuditReport& report) {
  const std::vector<std::shared_ptr<const Curve>> curves = domain.curves();
  if (curves.empty()) return;
  constexpr double kWithin = 1e-6;  // of the domain's diagonal
  const double within_mm = kWithin * domain.bounds().diagonal();
  const std::set<Edge> edges = edges_of(match);
  // About the length of a boundary edge: of n points on a surface as wide as the bounds.
  const double step_mm = domain.bounds().diagonal() / std::sqrt(static_cast<double>(boundary.size()) + 1);
  const BoundaryVertices vertices(mesh, boundary, step_mm);
  Tally broken{"audit.curve"};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Curve& curve = *curves[i];
    const auto miss = [&](const Point& where) { broken.hit(where, [&] { return name_of(curve, i); }); };
    const std::vector<OnCurve> on = vertices_on(curve, vertices, within_mm);
    if (on.empty()) {
      miss(curve.at(0));
      continue;
    }
    const bool is_closed = !curve.corners().has_value();
    if (!is_closed && on.front().along_mm > within_mm) miss(curve.at(0));
    if (!is_closed && on.back().along_mm < curve.length_mm() - within_mm) miss(curve.at(curve.length_mm()));
    for (std::size_t k = 0; k + 1 < on.size() + (is_closed ? 1 : 0); ++k) {
      const OnCurve& next = on[(k + 1) % on.size()];
      if (edges.count(std::minmax(on[k].vertex, next.vertex)) == 0) miss(curve.at(on[k].along_mm));
    }
  }
  record(broken, report);
}

}  // namespace scantet::auditing
