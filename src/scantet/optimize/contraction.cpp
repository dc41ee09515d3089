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
  facets_ = guard_.facets(u, other_);
  facets_.add(guard_.facets(v, fan_));
  moved_facets_.clear();
  add_moved(fan_, u, u);
  add_moved(other_, v, u);
  const Point start = guard_.middle_on_surface(v, u, facets_, fan_).value_or(complex_.point(u));
  return search_.run_on_surface(start, guard_, {facets_, moved_facets_, fan_, lid_without(v, u)});
}

/// Adds the facets of a fan to moved_facets_, but for those at `without`, with u in the place of the fan's vertex.
void Contraction::add_moved(const Fan& fan, VertexId without, VertexId u) {
  for (std::size_t i = 0; i < fan.rim.size(); ++i) {
    const VertexId p = fan.rim[i];
    const VertexId q = fan.rim[(i + 1) % fan.rim.size()];
    if (p == without || q == without) continue;
    moved_facets_.add({complex_.point(u), complex_.point(p), complex_.point(q)}, guard_.touches_curve({u, p, q}));
  }
}

/// Pre: v is free on the surface, with the fan fan_.
bool Contraction::keeps_topology(VertexId v, VertexId u) {
  const bool is_free = guard_.freedom(u, other_) == Freedom::on_surface;
  if (!is_free && !complex_.on_curve(u)) return false;
  const std::vector<VertexId> near_u = is_free ? other_.rim : guard_.boundary_neighbours(u);
  if (fan_.rim.size() == 3 && (!is_free || other_.rim.size() == 3)) return false;  // a tet's surface would be gone
  const auto in_fan = [&](VertexId w) { return std::find(fan_.rim.begin(), fan_.rim.end(), w) != fan_.rim.end(); };
  if (!in_fan(u) || std::count_if(near_u.begin(), near_u.end(), in_fan) != 2) return false;
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
  add_moved(fan_, u, u);
  const std::optional<Lid> lid = lid_without(v, u);
  if (lid && lid->turns_over(complex_.point(u))) return kInverted;
  if (complex_.on_curve(u) && !guard_.has_surface_near(facets_, fan_)) return kInverted;
  return guard_.rate_replacement(facets_, moved_facets_, fan_);
}

/// The lid of the hollow that u has part in once v has gone to u. Pre: keeps_topology(v, u).
std::optional<Lid> Contraction::lid_without(VertexId v, VertexId u) const {
  if (complex_.on_curve(u) || fan_.rim.size() + other_.rim.size() != 7) return std::nullopt;  // two are in both
  std::vector<VertexId> rim = fan_.rim;
  rim.insert(rim.end(), other_.rim.begin(), other_.rim.end());
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  std::erase_if(rim, [&](VertexId w) { return w == u || w == v; });
  return guard_.lid_of(rim, {u, v});
}

}  // namespace scantet::optimize
