// Whether a domain is noise at the size of a mesh.
#pragma once

#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

/// Whether the domain has more narrow places (Domain::size_hints) than its bounds have cubes of side σ, and over
/// 50,000: then tets of that size can show few of them, and points for each would make the mesh many times as large as
/// was asked for. Noise without any smoothing has three in each cube of two voxels, brains and noise smoothed by 1.2
/// voxels one in fifty.
bool is_noise(const Domain& domain, const SizingField& size);

}  // namespace scantet
