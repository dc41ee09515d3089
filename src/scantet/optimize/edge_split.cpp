// Each tet at the edge becomes two, one with each of its ends; what they share is the new vertex, which is free to
// leave the edge.
#include <algorithm>

#include "scantet/base/mesh_topology.h"
#include "scantet/optimize/edge_split_impl.h"

namespace scantet::optimize {

void EdgeSplit::try_edge(VertexId a, VertexId b, Change& best) {
  if (!divide(a, b)) return;
  const auto is_new = [&](TetId t) {
    const Tet& tet = complex_.tet(t);
    return *std::max_element(tet.begin(), tet.end()) >= first_new_;
  };
  const bool has_new = std::any_of(removed_.begin(), removed_.end(), is_new);
  const auto step = [](const Point& from, const Vec& direction, double length_mm) {
    return from + length_mm * direction;
  };
  const Point middle = lerp(complex_.point(a), complex_.point(b), 0.5);
  const Place place = search_.run(middle, kNoFacets, step, [](const Point&, double) { return kNoFacets; });
  if (place.sharpest >= best.sharpest || (has_new && place.sharpest > bound_)) return;
  best.reset(place.sharpest);
  best.vertex = kNewVertex;
  best.position = place.point;
  best.on_boundary = false;
  best.removed = removed_;
  best.added = added_;
  best.read = removed_;
}

/// Divides the tets at the edge ab in two. Returns false if the edge does not lie inside of one region.
bool EdgeSplit::divide(VertexId a, VertexId b) {
  search_.clear();
  removed_.clear();
  added_.clear();
  from_.clear();
  to_.clear();
  for (const TetId t : complex_.star(a)) {
    const Tet& tet = complex_.tet(t);
    if (!has_vertex(tet, b)) continue;
    if (!removed_.empty() && complex_.region(t) != complex_.region(removed_.front())) return false;
    removed_.push_back(t);
    for (const VertexId end : {a, b}) {
      const Triangle face = face_of(tet, corner_index(tet, end));
      search_.add_face(complex_.point(face[0]), complex_.point(face[1]), complex_.point(face[2]));
      added_.push_back({tet, complex_.region(t)});
      std::replace(added_.back().vertex.begin(), added_.back().vertex.end(), end, kNewVertex);
    }
    const auto [from, to] = opposite_edge(tet, a, b);
    from_.push_back(from);
    to_.push_back(to);
  }
  std::sort(from_.begin(), from_.end());
  std::sort(to_.begin(), to_.end());
  return from_ == to_;  // inside, each vertex around the edge belongs to a tet on either side of it
}

}  // namespace scantet::optimize
