// Inside, a vertex may step to all sides. On the surface it steps along the tangent plane of its facets and from there
// along their normal onto the surface again; on a curve it steps along that.
#include <algorithm>
#include <cmath>

#include "scantet/optimize/smoothing_impl.h"

namespace scantet::optimize {

void Smoothing::try_vertex(VertexId v, Change& best) {
  const Freedom freedom = guard_.freedom(v, fan_);
  const Point& start = complex_.point(v);
  const Curve* const curve = freedom == Freedom::none ? curve_of(v) : nullptr;
  if (freedom == Freedom::none && curve == nullptr) return;
  search_.clear();
  search_.add_star(complex_, v);
  std::optional<Place> place;
  if (freedom == Freedom::inside) place = find_inside(start);
  if (freedom == Freedom::on_surface) place = find_on_surface(v);
  if (freedom == Freedom::none) place = find_on_curve(v, *curve);
  if (!place || place->sharpest >= best.sharpest) return;
  if (freedom == Freedom::on_surface && !guard_.same_component(start, place->point)) return;
  best.reset(place->sharpest);
  best.vertex = v;
  best.position = place->point;
  best.on_boundary = freedom != Freedom::inside;
  best.read.assign(complex_.star(v).begin(), complex_.star(v).end());
}

/// The curve that v may move along; null for a corner, and where several curves come together.
const Curve* Smoothing::curve_of(VertexId v) const {
  return curves_ != nullptr && complex_.on_curve(v) ? curves_->curve_at(complex_.point(v)) : nullptr;
}

Place Smoothing::find_inside(const Point& start) {
  return search_.run(
      start, kNoFacets,
      [](const Point& from, const Vec& direction, double length_mm) { return from + length_mm * direction; },
      [](const Point&, double) { return kNoFacets; });
}

Place Smoothing::find_on_surface(VertexId v) {
  const Facets facets = guard_.facets(v, fan_);
  moved_facets_ = facets;
  return search_.run_on_surface(complex_.point(v), guard_,
                                {facets, moved_facets_, fan_, guard_.lid_of(fan_.rim, {v}), guard_.sharpest(facets)});
}

/// Nothing where the mesh has several curves in v.
std::optional<Place> Smoothing::find_on_curve(VertexId v, const Curve& curve) {
  const std::vector<FacetBetween> facets = guard_.facets_on_curve(v);
  if (facets.empty()) return std::nullopt;
  // Of the directions only those along the x axis count: to and fro.
  const auto step = [&](const Point& from, const Vec& direction, double length_mm) -> std::optional<Point> {
    if (std::abs(direction.x) != 1) return std::nullopt;
    return CurveGuide::step_along(curve, from, direction.x * length_mm);
  };
  std::vector<std::optional<double>> squared_bounds(facets.size());
  const auto rate = [&](const Point& p, double) {
    for (std::size_t i = 0; i < facets.size(); ++i) {
      const Corners there{p, facets[i].corners[1], facets[i].corners[2]};
      if (!guard_.may_move(facets[i], there, squared_bounds[i])) return kInverted;
    }
    return kNoFacets;
  };
  return search_.run(complex_.point(v), kNoFacets, step, rate);
}

}  // namespace scantet::optimize
