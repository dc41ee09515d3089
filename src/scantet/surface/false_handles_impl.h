// Private: handles of the mesh's boundary that the domain's has not.
#pragma once

#include <vector>

#include "scantet/base/triangle_surface.h"
#include "scantet/delaunay/triangulation_impl.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet::engine {

/// Around a handle of the boundary, or through it, leads a short path that does not part it. Across the path is a disk
/// that is within the boundary, or not. Where a fourth of it or more is on the other side in the domain, that has no
/// such handle.
///
/// boundary: of the triangulation's regions from `first` on, with the triangulation's vertices in their order. Paths
/// are up to twice the size long. Return: places on such disks that are on the other side; each disk has a group, with
/// the first place the one nearest to its centre. The smallest first; of two that are close to each other, the smaller
/// one.
std::vector<Misplaced> false_handles(const TriangleSurface& boundary, Region first, Triangulation& t,
                                     const Domain& domain, const SizingField& size);

}  // namespace scantet::engine
