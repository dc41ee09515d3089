// How large the facets on the boundary of a mesh will be.
#pragma once

#include <limits>

#include "scantet/base/api.h"
#include "scantet/domain/sizing_field.h"

namespace SCANTET_API scantet {

/// The bounds that facets obey (rule R2), as far as an object must know them before it is meshed.
struct FacetSizes {
  const SizingField& size;                                       ///< σ
  double alpha = 1;                                              ///< surface balls have at most α·σ as radius
  double distance_mm = std::numeric_limits<double>::infinity();  ///< of circumcentres from the surface, at most
};

}  // namespace scantet
