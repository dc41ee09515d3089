// The faces around the star of v are joined to u instead, which fills the star if all tets are positively oriented. A
// vertex of the boundary takes its facets along; then the link condition keeps the topology: the neighbours that u and
// v share are those of the edge uv, in the mesh and on its boundary.
#include <algorithm>

#include "scantet/optimize/contraction_impl.h"

namespace scantet::optimize {
namespace {

/// Collects the vertices of those of the tets that are wanted, in ascending order and each once.
template <class Wanted>
void collect_vertices(const TetComplex& complex, std::span<const TetId> tets, const Wanted& wanted,
                      std::vector<VertexId>& vertices) {
  vertices.clear();
  for (const TetId t : tets) {
    const Tet& tet = complex.tet(t);
    if (wanted(tet)) vertices.insert(vertices.end(), tet.begin(), tet.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

bool contains(const std::vector<VertexId>& ascending, VertexId v) {
  return std::binary_search(ascending.begin(), ascending.end(), v);
}

}  // namespace

void Contraction::try_edge(VertexId v, VertexId u, Change& best) {
  const Freedom freedom = guard_.freedom(v, fan_);
  if (freedom == Freedom::none) return;
  added_.clear();
  double sharpest = bound_;
  for (const TetId t : complex_.star(v)) {
    Tet tet = complex_.tet(t);
    if (has_vertex(tet, u)) continue;
    std::replace(tet.begin(), tet.end(), v, u);
    sharpest = std::max(sharpest, complex_.sharpness(tet, best.sharpest));
    if (sharpest >= best.sharpest) return;
    added_.push_back({tet, complex_.region(t)});
  }
  const bool on_surface = freedom == Freedom::on_surface;
  if (on_surface) {
    if (!keeps_topology(v, u)) return;
    sharpest = std::max(sharpest, rate_facets(v, u));
    if (sharpest >= best.sharpest) return;
  }
  best.reset(sharpest);
  best.added = added_;
  best.removed.assign(complex_.star(v).begin(), complex_.star(v).end());
  best.read = best.removed;
  if (on_surface) best.read.insert(best.read.end(), complex_.star(u).begin(), complex_.star(u).end());
}

void Contraction::try_edge_moving(VertexId v, VertexId u, Change& best) {
  const Freedom freedom = guard_.freedom(v, fan_);
  if (freedom == Freedom::none || guard_.freedom(u, other_) != freedom) return;
  const bool on_surface = freedom == Freedom::on_surface;
  if (on_surface && !keeps_topology(v, u)) return;
  search_.clear();
  search_.add_star(complex_, v, u);
  search_.add_star(complex_, u, v);
  const Place place = on_surface ? place_on_surface(v, u) : place_inside(v, u);
  if (place.sharpest >= best.sharpest) return;
  if (on_surface && !guard_.same_component(complex_.point(u), place.point)) return;
  best.reset(place.sharpest);
  add_tets(v, u);
  best.added = added_;
  best.removed.assign(complex_.star(v).begin(), complex_.star(v).end());
  best.vertex = u;
  best.position = place.point;
  best.on_boundary = on_surface;
  best.read = best.removed;
  best.read.insert(best.read.end(), complex_.star(u).begin(), complex_.star(u).end());
}

/// Lists in added_ the tets of v without u, with u in the place of v.
void Contraction::add_tets(VertexId v, VertexId u) {
  added_.clear();
  for (const TetId t : complex_.star(v)) {
    Tet tet = complex_.tet(t);
    if (has_vertex(tet, u)) continue;
    std::replace(tet.begin(), tet.end(), v, u);
    added_.push_back({tet, complex_.region(t)});
  }
}

Place Contraction::place_inside(VertexId v, VertexId u) {
  return search_.run(
      lerp(complex_.point(v), complex_.point(u), 0.5), kNoFacets,
      [](const Point& from, const Vec& direction, double length_mm) { return from + length_mm * direction; },
      [](const Point&, double) { return kNoFacets; });
}

/// From the middle of the edge, put on the surface along the normal of the facets of both.
Place Contraction::place_on_surface(VertexId v, VertexId u) {
  const std::vector<Corners> of_v = guard_.facets(v, fan_);
  facets_ = guard_.facets(u, other_);
  moved_facets_.clear();
  const auto keep_without = [&](const Fan& fan, const std::vector<Corners>& facets, VertexId without) {
    for (std::size_t i = 0; i < fan.rim.size(); ++i) {
      if (fan.rim[i] == without || fan.rim[(i + 1) % fan.rim.size()] == without) continue;
      moved_facets_.push_back(facets[i]);
    }
  };
  keep_without(fan_, of_v, u);
  keep_without(other_, facets_, v);
  facets_.insert(facets_.end(), of_v.begin(), of_v.end());
  const Vec normal = SurfaceGuard::mean_normal(facets_);
  SurfaceGuard::Known known;
  const auto rate = [&](const Point& p, double too_sharp) {
    for (Corners& facet : moved_facets_) facet[0] = p;
    return guard_.rate_replacement(facets_, moved_facets_, fan_, known, too_sharp);
  };
  const auto step = [&](const Point& from, const Vec& direction, double length_mm) {
    return guard_.step_along(from, direction, length_mm, normal, fan_);
  };
  const Vec reach = 0.5 * distance(complex_.point(v), complex_.point(u)) * normal;
  const Point middle = lerp(complex_.point(v), complex_.point(u), 0.5);
  const Point start = guard_.nearest(middle, reach, fan_).value_or(complex_.point(u));
  return search_.run(start, rate(start, kInverted), step, rate);
}

bool Contraction::keeps_topology(VertexId v, VertexId u) {
  if (guard_.freedom(u, other_) != Freedom::on_surface) return false;
  if (fan_.rim.size() == 3 && other_.rim.size() == 3) return false;  // the surface of a tet: it would be gone
  const auto in_fan = [&](VertexId w) { return std::find(fan_.rim.begin(), fan_.rim.end(), w) != fan_.rim.end(); };
  if (!in_fan(u) || std::count_if(other_.rim.begin(), other_.rim.end(), in_fan) != 2) return false;
  collect_vertices(
      complex_, complex_.star(v), [](const Tet&) { return true; }, near_v_);
  collect_vertices(
      complex_, complex_.star(v), [&](const Tet& tet) { return has_vertex(tet, u); }, near_edge_);
  for (const TetId t : complex_.star(u)) {
    for (const VertexId w : complex_.tet(t)) {
      if (contains(near_v_, w) && !contains(near_edge_, w)) return false;
    }
  }
  return true;
}

/// How sharp the facets of v would be if v went to u; kInverted if they may not go there.
double Contraction::rate_facets(VertexId v, VertexId u) {
  facets_ = guard_.facets(v, fan_);
  moved_facets_.clear();
  for (std::size_t i = 0; i < fan_.rim.size(); ++i) {
    if (fan_.rim[i] == u || fan_.rim[(i + 1) % fan_.rim.size()] == u) continue;
    moved_facets_.push_back({complex_.point(u), facets_[i][1], facets_[i][2]});
  }
  return guard_.rate_replacement(facets_, moved_facets_, fan_);
}

}  // namespace scantet::optimize
