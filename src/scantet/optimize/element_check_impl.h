// Private: what is bad about the elements of a complex, tets and boundary facets alike.
#pragma once

#include "scantet/optimize/facet_judge_impl.h"
#include "scantet/optimize/tet_complex_impl.h"

namespace scantet::optimize {

inline constexpr double kNoFacets = -1;  ///< as sharp as no facets are

/// Looks at tets with the complex's judge and at boundary facets with one of their own, on the same scale. Const
/// methods may be called from many threads while the complex stays as it is.
class ElementCheck {
 public:
  /// facets: null if nothing is asked of them. Both must outlive the check.
  ElementCheck(const TetComplex& complex, const FacetJudge* facets) : complex_(complex), facets_(facets) {}

  double bound() const { return complex_.judge().bound(); }

  /// Of a boundary facet; kNoFacets if nothing is asked of it. crossings: room to work in.
  double of_facet(const Corners& facet, Crossings& crossings) const;
  /// Of the face of t opposite to its corner k; kNoFacets if it is inside.
  double of_face(TetId t, int k) const;
  /// Of t, if it breaks a bound; else of the sharpest of it and its boundary faces. A tet is mended before its faces:
  /// faces never get worse by that, so there is an end to it.
  double of(TetId t) const;
  /// Of the sharpest of its boundary faces.
  double of_faces(TetId t) const;

 private:
  const TetComplex& complex_;
  const FacetJudge* facets_;
};

}  // namespace scantet::optimize
