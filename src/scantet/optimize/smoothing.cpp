// Inside, a vertex may step to all sides. On the surface it steps along the tangent plane of its facets and from there
// along their normal onto the surface again.
#include <algorithm>

#include "scantet/base/mesh_topology.h"
#include "scantet/optimize/smoothing_impl.h"

namespace scantet::optimize {

void Smoothing::try_vertex(VertexId v, Change& best) {
  const Freedom freedom = guard_.freedom(v, fan_);
  if (freedom == Freedom::none) return;
  search_.clear();
  for (const TetId t : complex_.star(v)) {
    const Triangle face = face_of(complex_.tet(t), corner_index(complex_.tet(t), v));
    search_.add_face(complex_.point(face[0]), complex_.point(face[1]), complex_.point(face[2]));
  }
  const bool on_surface = freedom == Freedom::on_surface;
  const Point& start = complex_.point(v);
  const Place place = on_surface ? find_on_surface(v) : find_inside(start);
  if (place.sharpest >= best.sharpest) return;
  if (on_surface && !guard_.same_component(start, place.point)) return;
  best.reset(place.sharpest);
  best.vertex = v;
  best.position = place.point;
  best.on_boundary = on_surface;
  best.read.assign(complex_.star(v).begin(), complex_.star(v).end());
}

Place Smoothing::find_inside(const Point& start) {
  return search_.run(
      start, kNoFacets,
      [](const Point& from, const Vec& direction, double length_mm) { return from + length_mm * direction; },
      [](const Point&, double) { return kNoFacets; });
}

Place Smoothing::find_on_surface(VertexId v) {
  const std::vector<Corners> facets = guard_.facets(v, fan_);
  const Vec normal = SurfaceGuard::mean_normal(facets);
  const auto step = [&](const Point& from, const Vec& direction, double length_mm) {
    return guard_.step_along(from, direction, length_mm, normal, fan_);
  };
  SurfaceGuard::Known known{std::nullopt, guard_.sharpest(facets)};
  const auto rate = [&](const Point& p, double too_sharp) {
    moved_facets_ = facets;
    for (Corners& facet : moved_facets_) facet[0] = p;
    return guard_.rate_replacement(facets, moved_facets_, fan_, known, too_sharp);
  };
  return search_.run(complex_.point(v), *known.sharpest, step, rate);
}

}  // namespace scantet::optimize
