// How much boundary a domain has at the scale of the sizes asked for, and how rough it is below that scale.
#pragma once

#include <optional>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace SCANTET_PROGRAM_API scantet {

/// What boundary points on lines parallel to the axes tell.
struct BoundaryLook {
  double cubes = 0;  ///< cubes of the size there that the boundary passes
  /// Small cubes in which the boundary is not nearly a plane: of two thirds of the size, or of two voxels if that is
  /// less.
  double bent = 0;
};

/// finest_mm: spacing of the voxels; none if the domain has none. Looks along a million lines at most: a size so small
/// that it takes more is scaled up, and the cubes are counted as if the boundary were flat below that. None if
/// cancelled. The same for any number of threads.
std::optional<BoundaryLook> look_at_boundary(const Domain& domain, const SizingField& size,
                                             std::optional<double> finest_mm, Progress& progress);

}  // namespace scantet
