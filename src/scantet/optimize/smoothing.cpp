// Inside, a vertex may step to all sides. On the surface it steps along the tangent plane of its facets and from there
// along their normal onto the surface again; on a curve it steps along that.
#include <algorithm>
#include <cmath>

#include "scantet/base/mesh_topology.h"
#include "scantet/optimize/smoothing_impl.h"

namespace scantet::optimize {

void Smoothing::try_vertex(VertexId v, Change& best) {
  const Freedom freedom = guard_.freedom(v, fan_);
  const Point& start = complex_.point(v);
  load(v);
  std::optional<Place> place;
  if (freedom == Freedom::inside) place = find_inside(start);
  if (freedom == Freedom::on_surface) place = find_on_surface(v);
  if (freedom == Freedom::none && curves_ != nullptr && complex_.on_curve(v)) place = find_on_curve(v);
  if (!place || place->sharpest >= best.sharpest) return;
  if (freedom == Freedom::on_surface && !guard_.same_component(start, place->point)) return;
  best.reset(place->sharpest);
  best.vertex = v;
  best.position = place->point;
  best.on_boundary = freedom != Freedom::inside;
  best.read.assign(complex_.star(v).begin(), complex_.star(v).end());
}

/// Tells the search the tets of v.
void Smoothing::load(VertexId v) {
  search_.clear();
  for (const TetId t : complex_.star(v)) {
    const Triangle face = face_of(complex_.tet(t), corner_index(complex_.tet(t), v));
    search_.add_face(complex_.point(face[0]), complex_.point(face[1]), complex_.point(face[2]));
  }
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

/// Nothing if v is a corner, or several curves come together in it.
std::optional<Place> Smoothing::find_on_curve(VertexId v) {
  const Point& start = complex_.point(v);
  const Curve* const curve = curves_->curve_at(start);
  if (curve == nullptr) return std::nullopt;
  const std::vector<FacetBetween> facets = guard_.facets_on_curve(v);
  if (facets.empty()) return std::nullopt;
  // Of the directions only those along the x axis count: to and fro.
  const auto step = [&](const Point& from, const Vec& direction, double length_mm) -> std::optional<Point> {
    if (std::abs(direction.x) != 1) return std::nullopt;
    return CurveGuide::step_along(*curve, from, direction.x * length_mm);
  };
  std::vector<std::optional<double>> squared_bounds(facets.size());
  const auto rate = [&](const Point& p, double) {
    for (std::size_t i = 0; i < facets.size(); ++i) {
      const Corners there{p, facets[i].corners[1], facets[i].corners[2]};
      if (!guard_.may_move(facets[i], there, squared_bounds[i])) return kInverted;
    }
    return kNoFacets;
  };
  return search_.run(start, kNoFacets, step, rate);
}

}  // namespace scantet::optimize
