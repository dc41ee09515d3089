// Private: what no single change makes better is shaken, and mended again.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/optimize/patch_impl.h"

namespace scantet::optimize {

/// How a part of the mesh is mended once it has been shaken.
struct Mending {
  const Domain& domain;
  const FacetJudge* facets;  ///< null if nothing is asked of facets
  double tolerance_mm;       ///< how far facets may be from the surface wherever they are
  /// Makes changes to the complex, the worst of the tets first; only such as are allowed.
  std::function<void(TetComplex&, const std::vector<TetId>& bad, const std::function<bool(const Change&)>& allows)>
      mend;
};

/// Improvement goes downhill: each change must leave the worst element better, so it ends where two vertices would have
/// to move at once. Here all vertices around such an element are put elsewhere, a little, along the surface where they
/// are on it, and the part around is mended anew; that is kept if it has fewer elements that break a bound, or the
/// worst is less sharp, and nothing is worse. So again and again, with other places, until none is left.
///
/// bad: the elements. Parts that do not touch are tried side by side. Returns how many parts became better. Guarantees:
/// as those of `mending`; places depend on the coordinates alone, so the result does not depend on the number of
/// threads. Cancelled: what is done stays.
std::uint64_t shake(TetComplex& complex, const Mending& mending, const std::vector<TetId>& bad, Progress& progress);

}  // namespace scantet::optimize
