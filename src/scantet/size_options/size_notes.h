// What the user is told of the sizes that were chosen: a sentence each, no full stop.
#pragma once

#include <string>
#include <vector>

#include "scantet/size_options/boundary_cones.h"
#include "scantet/size_options/layer_sizes.h"
#include "scantet/sizing/size_grid.h"

namespace scantet {

/// No size was asked for: it is the input's own. size: as the report has it.
std::string note_on_default(const std::string& size, const std::string& reason);

/// Sizes vary inside: from where on, and how far off a grid has them.
std::string note_on_grid(const SizeGrid& grid);

/// Sizes go by the shape of the boundary: from and to where, by what, and what may have been missed. cones: what
/// auto_cones made of `how`, not empty.
std::string note_on_auto(const BoundaryCones& cones, const AutoSizes& how);

/// What --layers does to sizes. sizes: in thin parts, if there are any.
std::string note_on_layers(const LayerSettings& settings, const std::vector<Cone>& sizes);

}  // namespace scantet
