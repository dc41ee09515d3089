// Private: what is bad about the elements of a complex, tets and boundary facets alike.
#pragma once

#include "scantet/optimize/facet_judge_impl.h"
#include "scantet/optimize/tet_complex_impl.h"

namespace scantet::optimize {

/// The sharpness of no facets at all: less than that of any facet.
inline constexpr double kNoFacets = -1;

/// Looks at tets with the complex's judge and at boundary facets with one of their own, on the same scale. Const
/// methods may be called from many threads while the complex stays as it is.
class ElementCheck {
 public:
  /// facets: null if nothing is asked of them. Both must outlive the check.
  ElementCheck(const TetComplex& complex, const FacetJudge* facets) : complex_(complex), facets_(facets) {}

  double bound() const { return complex_.judge().bound(); }

  /// The sharpness of a boundary facet; kNoFacets if nothing is asked of facets. crossings: room to work in.
  double of_facet(const Corners& facet, Crossings& crossings) const;
  /// What of that the facet's shape alone says: no more than of_facet(). Does not ask the domain.
  double by_shape(const Corners& facet) const;
  /// The sharpness of the face of t opposite to its corner k; kNoFacets if that face does not lie on the boundary.
  double of_face(TetId t, int k) const;
  /// The sharpness of t alone if t breaks a bound; otherwise that of the sharpest among t and its boundary faces. So a
  /// tet is mended before its faces are. Mending a tet never makes a face worse, so this comes to an end.
  double of(TetId t) const;
  /// The sharpness of the sharpest boundary face of t; kNoFacets if it has none.
  double of_faces(TetId t) const;

 private:
  const TetComplex& complex_;
  const FacetJudge* facets_;
};

}  // namespace scantet::optimize
