// The complex does not store which faces lie on the boundary. That is found from the stars, and asked only of faces
// whose three vertices lie on the boundary, for no other face can; nothing is asked of those at curves.
#include <algorithm>

#include "scantet/base/mesh_topology.h"
#include "scantet/optimize/element_check_impl.h"

namespace scantet::optimize {

double ElementCheck::of_facet(const Corners& facet, Crossings& crossings) const {
  if (facets_ == nullptr) return kNoFacets;
  return complex_.judge().sharpness_of_share(facets_->shares(facet, crossings).least());
}

double ElementCheck::by_shape(const Corners& facet) const {
  return facets_ == nullptr ? kNoFacets : complex_.judge().sharpness_of_share(facets_->share_of_shape(facet));
}

double ElementCheck::of_face(TetId t, int k) const {
  if (facets_ == nullptr) return kNoFacets;
  const Triangle face = face_of(complex_.tet(t), k);
  const auto on_boundary = [&](VertexId v) { return complex_.on_boundary(v) && !complex_.on_curve(v); };
  if (!std::all_of(face.begin(), face.end(), on_boundary) || !complex_.is_boundary_face(t, k)) return kNoFacets;
  Crossings crossings;
  return of_facet({complex_.point(face[0]), complex_.point(face[1]), complex_.point(face[2])}, crossings);
}

double ElementCheck::of_faces(TetId t) const {
  double sharpest = kNoFacets;
  for (int k = 0; k < 4; ++k) sharpest = std::max(sharpest, of_face(t, k));
  return sharpest;
}

double ElementCheck::of(TetId t) const {
  const double of_tet = complex_.sharpness(complex_.tet(t));
  return of_tet > bound() ? of_tet : std::max(of_tet, of_faces(t));
}

}  // namespace scantet::optimize
