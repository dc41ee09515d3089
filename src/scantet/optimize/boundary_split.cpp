// Where one end of the edge is free on the surface, the two facets at the edge are neighbours in its fan, and the tets
// at the edge, of both regions, fill the place around it. Each becomes two, one with each end.
#include <algorithm>

#include "scantet/optimize/boundary_split_impl.h"

namespace scantet::optimize {

void BoundarySplit::try_edge(VertexId a, VertexId b, Change& best) {
  if (!find_facets(a, b) && !find_facets(b, a)) return;
  search_.clear();
  tets_.divide(complex_, a, b, search_);
  const std::optional<Point> start = guard_.middle_on_surface(a, b, facets_, fan_);
  if (!start) return;
  const Place place = search_.run_on_surface(*start, guard_, {facets_, divided_, fan_});
  if (place.sharpest >= best.sharpest) return;
  if (place.sharpest > complex_.judge().bound() && tets_.have_vertex_from(complex_, first_new_)) return;
  if (!guard_.same_component(complex_.point(a), place.point)) return;
  tets_.put_into(best, place, true);
  best.read.assign(complex_.star(a).begin(), complex_.star(a).end());
  best.read.insert(best.read.end(), complex_.star(b).begin(), complex_.star(b).end());
}

/// Lists the facets at the edge from v to w, and what becomes of them; the new vertex is put in the middle. Returns
/// false if v is not free on the surface, or no facet leads to w.
bool BoundarySplit::find_facets(VertexId v, VertexId w) {
  if (guard_.freedom(v, fan_) != Freedom::on_surface) return false;
  const auto at = std::find(fan_.rim.begin(), fan_.rim.end(), w);
  if (at == fan_.rim.end()) return false;
  const VertexId next = at + 1 == fan_.rim.end() ? fan_.rim.front() : *(at + 1);
  const VertexId last = at == fan_.rim.begin() ? fan_.rim.back() : *(at - 1);
  const auto point = [&](VertexId u) { return complex_.point(u); };
  const Point middle = lerp(point(v), point(w), 0.5);
  facets_.clear();
  facets_.add({point(v), point(w), point(next)}, guard_.touches_curve({v, w, next}));
  facets_.add({point(v), point(last), point(w)}, guard_.touches_curve({v, last, w}));
  divided_.clear();
  divided_.add({middle, point(w), point(next)}, guard_.touches_curve({w, next}));
  divided_.add({middle, point(next), point(v)}, guard_.touches_curve({next, v}));
  divided_.add({middle, point(v), point(last)}, guard_.touches_curve({v, last}));
  divided_.add({middle, point(last), point(w)}, guard_.touches_curve({last, w}));
  return true;
}

}  // namespace scantet::optimize
