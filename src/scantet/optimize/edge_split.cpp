// Each tet at the edge becomes two, one with each of its ends; what they share is the new vertex, which is free to
// leave the edge.
#include <algorithm>

#include "scantet/base/mesh_topology.h"
#include "scantet/optimize/edge_split_impl.h"

namespace scantet::optimize {

void DividedTets::divide(const TetComplex& complex, VertexId a, VertexId b, PlaceSearch& search) {
  removed.clear();
  added.clear();
  for (const TetId t : complex.star(a)) {
    const Tet& tet = complex.tet(t);
    if (!has_vertex(tet, b)) continue;
    removed.push_back(t);
    for (const VertexId end : {a, b}) {
      const Triangle face = face_of(tet, corner_index(tet, end));
      search.add_face(complex.point(face[0]), complex.point(face[1]), complex.point(face[2]));
      added.push_back({tet, complex.region(t)});
      std::replace(added.back().vertex.begin(), added.back().vertex.end(), end, kNewVertex);
    }
  }
}

bool DividedTets::have_vertex_from(const TetComplex& complex, VertexId first) const {
  return std::any_of(removed.begin(), removed.end(), [&](TetId t) {
    const Tet& tet = complex.tet(t);
    return *std::max_element(tet.begin(), tet.end()) >= first;
  });
}

void DividedTets::put_into(Change& change, const Place& place, bool on_boundary) const {
  change.reset(place.sharpest);
  change.vertex = kNewVertex;
  change.position = place.point;
  change.on_boundary = on_boundary;
  change.removed = removed;
  change.added = added;
}

void EdgeSplit::try_edge(VertexId a, VertexId b, Change& best) {
  if (!divide(a, b)) return;
  const auto step = [](const Point& from, const Vec& direction, double length_mm) {
    return from + length_mm * direction;
  };
  const Point middle = lerp(complex_.point(a), complex_.point(b), 0.5);
  const Place place = search_.run(middle, kNoFacets, step, [](const Point&, double) { return kNoFacets; });
  if (place.sharpest >= best.sharpest || (place.sharpest > bound_ && tets_.have_vertex_from(complex_, first_new_)))
    return;
  tets_.put_into(best, place, false);
  best.read = tets_.removed;
}

/// Divides the tets at the edge ab. Returns false if the edge does not lie inside of one region.
bool EdgeSplit::divide(VertexId a, VertexId b) {
  search_.clear();
  tets_.divide(complex_, a, b, search_);
  const auto& removed = tets_.removed;
  const auto is_other = [&](TetId t) { return complex_.region(t) != complex_.region(removed.front()); };
  if (std::any_of(removed.begin(), removed.end(), is_other)) return false;
  from_.clear();
  to_.clear();
  for (const TetId t : removed) {
    const auto [from, to] = opposite_edge(complex_.tet(t), a, b);
    from_.push_back(from);
    to_.push_back(to);
  }
  std::sort(from_.begin(), from_.end());
  std::sort(to_.begin(), to_.end());
  return from_ == to_;  // inside, each vertex around the edge belongs to a tet on either side of it
}

}  // namespace scantet::optimize
