// Private: crumbs of the mesh that no sampling would join to the rest.
#pragma once

#include "scantet/domain/sizing_field.h"
#include "scantet/refine/restricted_triangulation_impl.h"

namespace scantet::refine {

/// Gives fragments to the other side: pieces of the inside or of the outside that are not the main piece of their
/// component of the domain and smaller than a cube of side α·σ. Returns how many cells changed sides.
///
/// Where the level set is pinched or folded to a wedge, D|O(P) breaks into tets that touch along edges or at vertices
/// only, however dense the sample (the surface is not Lipschitz there: paper, section 6). Without them the mesh has the
/// domain's components.
std::uint64_t absorb_fragments(const RestrictedTriangulation& triangulation, const SizingField& size, double alpha);

}  // namespace scantet::refine
