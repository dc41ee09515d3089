// A mesh follows a curve of its domain if the boundary vertices that lie on it, in their order along it, are joined by
// edges of boundary facets, from end to end, or all around.
#include <algorithm>
#include <set>

#include "scantet/check/audit_impl.h"

namespace scantet::auditing {
namespace {

using Edge = std::pair<VertexId, VertexId>;

struct OnCurve {
  double along_mm;
  VertexId vertex;
};

std::vector<OnCurve> vertices_on(const Curve& curve, const TetMesh& mesh, const std::vector<VertexId>& boundary,
                                 double within_mm) {
  std::vector<OnCurve> found;
  for (const VertexId v : boundary) {
    const Curve::Nearest nearest = curve.nearest(mesh.vertices[v]);
    if (nearest.distance_mm <= within_mm) found.push_back({nearest.along_mm, v});
  }
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
  Tally broken{"audit.curve"};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Curve& curve = *curves[i];
    const auto miss = [&](const Point& where) { broken.hit(where, [&] { return name_of(curve, i); }); };
    const std::vector<OnCurve> on = vertices_on(curve, mesh, boundary, within_mm);
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
